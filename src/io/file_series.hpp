// SPDX-License-Identifier: BSD-3-Clause
// The JSON file by which ParaView plays files as a time series ("file-series-version" 1.0 of VTK).
#pragma once

#include <span>
#include <string>

namespace trime::io {

/// A file and the time at which it is shown.
struct NamedTime {
  std::string file; ///< relative to the directory of the series
  int time = 0;
};

/// Text of NAME.vtkhdf.series. Bytes of a name that are no UTF-8 are replaced, since JSON cannot hold them.
std::string file_series_text(std::span<const NamedTime> files);

} // namespace trime::io
