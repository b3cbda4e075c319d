// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_series.hpp"

#include <nlohmann/json.hpp>

namespace trime::io {

std::string file_series_text(std::span<const NamedTime> files) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const NamedTime& member : files)
    list.push_back(Json{{"name", member.file}, {"time", member.time}});
  const Json series{{"file-series-version", "1.0"}, {"files", list}};
  return series.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace trime::io
