// SPDX-License-Identifier: BSD-3-Clause
// A damaged mesh file: `trime_mpi info`, or `trime_mpi convert` into one of the formats. One of them for each input,
// since reading the metadata, which both do, takes most of the time.
#include "app/convert.hpp"
#include "damaged_file.hpp"
#include "fuzz.hpp"
#include "trime/formats/exchange.hpp"

const bool trime::fuzz::damages_checkpoints = false;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  fuzz::DamagedFile& file = fuzz::good_file();
  const std::string& path = file.damage(data, size);
  const auto every_format = formats::all_formats();
  const std::size_t choice = size == 0 ? 0 : data[0] % (every_format.size() + 1);
  if (choice == every_format.size()) {
    fuzz::survives([&] { app::info(path, false, file.comm()); });
    return 0;
  }
  const auto& format = every_format[choice];
  const app::CommandLine line{
      .action = app::Action::convert, .files = {path, file.directory() + "/out" + format.ending}, .overwrite = true};
  fuzz::survives([&] {
    Log log(LogLevel::silent, true);
    app::convert(line, nullptr, file.comm(), log);
  });
  return 0;
}
