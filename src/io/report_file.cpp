// SPDX-License-Identifier: BSD-3-Clause
#include "io/report_file.hpp"

#include "comm/agree.hpp"
#include "core/quoted.hpp"
#include "core/read_file.hpp"
#include "io/temporary_file.hpp"

#include <nlohmann/json.hpp>
#include <unistd.h>

#include <filesystem>

namespace trime::io {
namespace {

using Json = nlohmann::ordered_json;

template <class... T>
Json json_of(const std::variant<T...>& value) {
  return std::visit([](const auto& held) { return Json(held); }, value);
}

Json json_of(const std::vector<Attribute>& attributes) {
  Json object = Json::object();
  for (const Attribute& attribute : attributes)
    object[attribute.name] = json_of(attribute.value);
  return object;
}

Json json_of(const MetadataGroup& group) {
  Json columns = Json::object();
  for (const Column& column : group.columns)
    columns[column.name] = json_of(column.values);
  return {{"attributes", json_of(group.attributes)}, {"columns", std::move(columns)}};
}

} // namespace

std::string report_json(const Metadata& metadata, const Outcome& outcome) {
  Json groups = Json::object();
  for (const MetadataGroup& group : metadata.groups)
    groups[group.name] = json_of(group);
  const Json report{{"format", "trime_mpi-report"},   {"format_version", report_version},
                    {"exit_code", outcome.exit_code}, {"files", outcome.files},
                    {"warnings", outcome.warnings},   {"attributes", json_of(metadata.attributes)},
                    {"groups", std::move(groups)}};
  return report.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void check_report_file(const std::string& path, const comm::Communicator& comm) {
  comm::run_agreed(comm, [&] {
    if (!comm.is_root())
      return;
    std::error_code error;
    if (const std::string problem = length_problem(path, longest_temporary_ending); !problem.empty())
      throw FileError(fmt::format("the report {} cannot be written: {}; choose a shorter one", shown(path), problem));
    if (const std::string kind = irregular_kind(path); !kind.empty())
      throw FileError(fmt::format("the report {} is {}, which a file would replace; name a regular file", path, kind));
    if (std::filesystem::is_symlink(path, error))
      throw FileError(fmt::format("the report {} is a link, which a file would replace; name the file itself", path));
    const std::filesystem::path parent = std::filesystem::path(path).parent_path();
    const std::string directory = parent.empty() ? "." : parent.string();
    if (access(directory.c_str(), W_OK | X_OK) != 0)
      throw FileError(fmt::format("the report {} cannot be written: {}: {}", path, directory, system_error()));
  });
}

void write_report_file(const std::string& path, const Metadata& metadata, const Outcome& outcome,
                       const comm::Communicator& comm) {
  comm::run_agreed(comm, [&] {
    if (comm.is_root())
      write_text_file(path, report_json(metadata, outcome), nullptr);
  });
}

} // namespace trime::io
