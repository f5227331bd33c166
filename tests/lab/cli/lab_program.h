#pragma once
// Runs the program of the laboratory, and that of the product where a test needs both.

#include "cli/program.h"

namespace panache::test {

class LabTest : public ProgramTest {
 protected:
  Ran run_panache(const Words& arguments, const std::string& model = "model.safetensors") const {
    return run(arguments, model, PANACHE_PRODUCT);
  }
};

}  // namespace panache::test
