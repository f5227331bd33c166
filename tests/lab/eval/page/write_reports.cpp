// write_reports FOLDER: the reports that page.test.mjs opens: `full`, `empty`, and `poor`, whose
// style classifier is not good enough and whose FMD was not measured.

#include <cstdio>

#include "eval/make_report.h"

int main(int argc, char** argv) {
  using namespace panache;
  if (argc != 2) return 2;
  Report poor;
  poor.real = test::numbers(0.97);
  poor.real["fmd"] = kNotMeasured;
  poor.real["style_accuracy"] = 0.94;
  poor.style_floor = 0.95;
  const std::pair<const char*, Report> reports[] = {
      {"full", test::made_up_report()}, {"empty", Report()}, {"poor", poor}};
  for (const auto& [name, report] : reports) {
    const Result<void> written = write_report(report, std::string(argv[1]) + "/" + name);
    if (written) continue;
    std::fprintf(stderr, "%s\n", written.error().message.c_str());
    return 1;
  }
}
