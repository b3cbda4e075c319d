// SPDX-License-Identifier: BSD-3-Clause
// A damaged mesh file: `trime_mpi info`, and `trime_mpi convert` into one of the formats.
#include "app/exchange.hpp"
#include "damaged_file.hpp"
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  static fuzz::DamagedFile file(false);
  const std::string& path = file.damage(data, size);
  fuzz::survives([&] { app::info(path, file.comm()); });
  const auto formats = formats::all_formats();
  const auto& format = formats[size == 0 ? 0 : data[0] % formats.size()];
  const app::CommandLine line{
      .action = app::Action::convert, .files = {path, file.directory() + "/out" + format.ending}, .overwrite = true};
  fuzz::survives([&] {
    Log log(LogLevel::silent, true);
    app::convert(line, nullptr, file.comm(), log);
  });
  return 0;
}
