#pragma once
// Comma-separated tables with a header row, as spreadsheets write them.

#include <string>
#include <vector>

#include "base/result.h"

namespace panache {

struct CsvRow {
  int line = 0;  // In the file, from 1.
  std::vector<std::string> values;
};
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<CsvRow> rows;
};

// Reads the table in the file at `path`. If `columns` are given, rows hold just these, in this
// order, and a missing one is an error; otherwise all columns of the file. `optional` columns
// follow; if the file lacks one, its cells are empty. Cells may be quoted.
Result<CsvTable> read_csv(const std::string& path, const std::vector<std::string>& columns = {},
                          const std::vector<std::string>& optional = {});

}  // namespace panache
