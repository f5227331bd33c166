#include "eval/report.h"
#include "eval/report_numbers.h"

namespace panache {

std::vector<std::string> ceiling_notes(const Report& report) {
  struct Judge {
    const char *name, *key, *figures;
    double floor;
  };
  const Judge judges[] = {{"style", "style_accuracy",
                           "style, style probability, strengths and mixes", report.style_floor},
                          {"content", "content_accuracy", "content and FMD", report.content_floor}};
  std::vector<std::string> notes;
  for (const Judge& judge : judges) {
    const double share = report.real[judge.key];
    if (share >= judge.floor || report.real.takes == 0) continue;
    notes.push_back(std::string("The ") + judge.name + " classifier recognises " +
                    number_text(share, 3) + " of the windows of real held-out takes, less than " +
                    number_text(judge.floor, 3) + ": compare its figures (" + judge.figures +
                    ") with those of the real takes, not with 1.");
  }
  return notes;
}

}  // namespace panache
