#pragma once
// Tests of the program that make GLB of FBX files; skipped where it is built without Assimp.

#include "clip/make_fbx.h"
#include "cli/program.h"

namespace panache::test {

class FbxProgramTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("walk.fbx", format_fbx(walking_clip(5)));
#ifndef PANACHE_ASSIMP
    GTEST_SKIP() << "this build has no Assimp";
#endif
  }
};

}  // namespace panache::test
