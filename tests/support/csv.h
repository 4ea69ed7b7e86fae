// Tables of numbers in tests: comma-separated, one header line, `#` comments, first column optionally a name.
#pragma once

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace scotopic::test {

struct CsvRow {
  std::string name;  // the first column, as text
  std::map<std::string, double> number;
  double operator[](const std::string& column) const { return number.at(column); }
};

inline std::vector<CsvRow> read_csv(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<std::string> columns;
  std::vector<CsvRow> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells;
    std::istringstream cell_stream(line);
    for (std::string cell; std::getline(cell_stream, cell, ',');) cells.push_back(cell);
    if (columns.empty()) {
      columns = cells;
      continue;
    }
    CsvRow row{cells.at(0), {}};
    for (std::size_t i = 0; i < cells.size(); ++i)
      row.number[columns.at(i)] = std::strtod(cells[i].c_str(), nullptr);
    rows.push_back(row);
  }
  if (rows.empty()) throw std::runtime_error("no rows in " + path);
  return rows;
}

}  // namespace scotopic::test
