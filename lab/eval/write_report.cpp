// The report as a folder.

#include "eval/report.h"

#include <filesystem>

#include "base/file.h"

namespace panache {

Result<void> write_report(const Report& report, const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code status;
  const fs::path path = folder.empty() ? "." : folder;
  if (fs::exists(path, status) && !fs::is_directory(path, status)) {
    return Error{folder + ": is a file; expected a folder to write the report into"};
  }
  fs::create_directories(path, status);
  if (!fs::is_directory(path, status)) {
    return Error{folder + ": cannot be made; expected a place where a folder may be written"};
  }
  const std::string json = report_json(report), page = report_page(report);
  Result<void> written = write_file((path / "report.json").string(), json, true);
  if (!written) return written;
  return write_file((path / "index.html").string(), page, true);
}

}  // namespace panache
