// SPDX-License-Identifier: BSD-3-Clause
// A damaged checkpoint: it is read whole, with the sites that its tiles claim to have.
#include "checkpoint/checkpoint_file.hpp"
#include "damaged_file.hpp"
#include "fuzz.hpp"

#include <numeric>

const bool trime::fuzz::damages_checkpoints = true;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  fuzz::DamagedFile& file = fuzz::good_file();
  const std::string& path = file.damage(data, size);
  fuzz::survives([&] {
    const checkpoint::Found found = checkpoint::read_checkpoint(path, file.comm());
    const std::vector<std::int64_t>& counts = found.run.tiles.counts;
    const std::int64_t all = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
    TRIME_ASSERT(static_cast<std::int64_t>(found.run.load(0, all).sites.size()) == all, "{} sites", all);
  });
  checkpoint::checkpoint_number(path);
  return 0;
}
