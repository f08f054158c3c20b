#include "batch/summary.h"

#include <fmt/format.h>

#include <string>

#include "batch/page.h"
#include "staged_output.h"

namespace unsnarl::app {
namespace {

const std::vector<std::string> run_columns = {"seconds", "cpu_s", "peak_memory_mb", "attempts", "host"};

std::string text_of(const Record& value) {
  return value.dump(-1, ' ', false, Record::error_handler_t::replace);
}

/// Text that a spreadsheet takes for text: what it would compute begins with one of these characters. The mark before
/// them goes before marks too, so that taking one mark away always gives the text back.
std::string harmless(const std::string& text) {
  constexpr std::string_view computed = "=+-@\t\r\n", mark = "'";
  const bool begins = !text.empty() && (computed.find(text[0]) != computed.npos || text.starts_with(mark));
  return begins ? std::string(mark) + text : text;
}

/// A value as a field of CSV (RFC 4180).
std::string csv_field(const Record& record, const std::string& column) {
  const auto found = record.find(column);
  if (found == record.end() || found->is_null()) return {};
  if (!found->is_string()) return text_of(*found);
  std::string text = harmless(found->get<std::string>());
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  for (std::size_t i = 0; (i = text.find('"', i)) != std::string::npos; i += 2) text.insert(i, 1, '"');
  return '"' + text + '"';
}

std::string csv_line(const Record& record, const std::vector<std::string>& columns) {
  std::vector<std::string> fields;
  for (const std::string& column : columns) fields.push_back(csv_field(record, column));
  return fmt::format("{}\n", fmt::join(fields, ","));
}

std::string heading(const std::vector<std::string>& columns) {
  return fmt::format("{}\n", fmt::join(columns, ","));
}

/// The columns, then the values of a mesh in each. Inside a script element, so '<' must not be there.
std::string page_data(const std::vector<Record>& records) {
  std::vector<std::string> columns = record_columns();
  columns.push_back("thumbnail");
  std::string text = R"({"columns":)" + text_of(Record(columns)) + ",\n\"rows\":[";
  for (const Record& record : records) {
    Record row = Record::array();
    for (const std::string& column : columns) row.push_back(record.value(column, Record()));
    text += &record == records.data() ? "\n" : ",\n";
    text += text_of(row);
  }
  text += "\n]}";
  for (std::size_t i = 0; (i = text.find('<', i)) != std::string::npos;) text.replace(i, 1, "\\u003c");
  return text;
}

std::string page(const std::vector<Record>& records) {
  constexpr std::string_view place = "@DATA@";
  std::string text(batch_page_template());
  return text.replace(text.find(place), place.size(), page_data(records));
}

}  // namespace

void write_batch_summary(const BatchFolder& folder, const std::vector<Record>& records, Interruption& interruption) {
  std::vector<std::string> timing_columns = {"mesh"};
  timing_columns.insert(timing_columns.end(), run_columns.begin(), run_columns.end());
  std::string lines, table = heading(record_columns()), timing = heading(timing_columns);
  Record script = Record::object();
  for (const Record& record : records) {
    Record lasting = record;
    lasting.erase("run");
    lines += text_of(lasting) + "\n";
    table += csv_line(record, record_columns());
    if (!record.contains("run")) continue;
    Record run = record["run"];
    run["mesh"] = record["mesh"];
    timing += csv_line(run, timing_columns);
    script[record["mesh"].get<std::string>()] = {run["seconds"], run["cpu_s"], run["peak_memory_mb"]};
  }
  const auto write = [&](const char* name, const std::string& bytes) {
    write_file((folder.root / name).string(), bytes, interruption);
  };
  write("results.jsonl", lines);
  write("results.csv", table);
  write("timing.csv", timing);
  write("timing.js", "const timing = " + text_of(script) + ";\n");
  write("index.html", page(records));
}

}  // namespace unsnarl::app
