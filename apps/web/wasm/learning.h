#pragma once
// A style learnt in the page, and what the page shows of it.

#include <span>
#include <string>
#include <string_view>

#include "base/result.h"
#include "clip/motion_file.h"

namespace panache::web {

// A motion of a file that is open.
struct Motion {
  const MotionFile& file;
  int which;
  std::string name;  // Of the file, for messages.
};

struct Learnt {
  std::string style;   // The bytes of a style file.
  std::string report;  // JSON, see index.d.ts: LearnReport.
};

// Learns the style called `style` on the bytes of a model from a neutral motion and a styled one.
Result<Learnt> learn(std::string_view model, const Motion& neutral, const Motion& styled,
                     const std::string& style);
// Without a neutral motion: with the bytes of a bank of it, see NeutralBank.
Result<Learnt> learn_alone(std::string_view model, std::string_view bank, const Motion& styled,
                           const std::string& style);

}  // namespace panache::web
