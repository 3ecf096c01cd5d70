// Where a table of ticks came from and what its columns are, in a file beside it: its header alone is a contract, and
// leaves no room for comments. By W3C's Metadata Vocabulary for Tabular Data (CSV on the Web, 2015), which reads
// NAME.csv-metadata.json beside NAME.csv.
#pragma once

#include "workbench/session/file_origin.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace tangent {

/// NAME.csv-metadata.json.
std::filesystem::path csv_metadata_path(const std::filesystem::path& table);

/// JSON: for every column of the header its title, datatype and unit (UCUM), and the origin's facts as provenance.
/// `file`: the table's name, without folder. A column that is not known has its name alone.
std::string csv_metadata(std::string_view file, std::string_view header, const FileOrigin& origin);

/// Beside the table, atomically. Where the table is no regular file (a pipe, /dev/stdout) nothing is written.
Status write_csv_metadata(const std::filesystem::path& table, std::string_view header, const FileOrigin& origin);

}  // namespace tangent
