#pragma once
// Tests of the program on FBX files; skipped where it is built without Assimp.

#include "cli/make_fbx.h"
#include "cli/program.h"

namespace panache::test {

class FbxProgramTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("walk.fbx", format_fbx(walking_clip(5)));
    if (run({"info", "walk.fbx"}).err.find("this build reads no FBX files") != std::string::npos) {
      GTEST_SKIP() << "this build has no Assimp";
    }
  }
};

}  // namespace panache::test
