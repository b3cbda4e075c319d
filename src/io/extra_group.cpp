// SPDX-License-Identifier: BSD-3-Clause
#include "io/extra_group.hpp"

namespace trime::io {
namespace {

hid_t native_type(ValueType type) {
  switch (type) {
  case ValueType::float64:
    return H5T_NATIVE_DOUBLE;
  case ValueType::int64:
    return H5T_NATIVE_INT64;
  default:
    return H5T_NATIVE_INT32;
  }
}

} // namespace

void write_group(SlabFile& file, const ExtraGroup& group) {
  file.group(group.path);
  for (const Attribute& attribute : group.attributes)
    file.attribute(group.path, attribute);
  for (const ExtraArray& array : group.arrays) {
    const std::string path = group.path + "/" + array.name;
    bool is_made = false;
    for (const ExtraRows& block : array.blocks) {
      SlabArray slab{path,
                     native_type(array.type),
                     static_cast<std::size_t>(bytes_of(array.type)),
                     static_cast<hsize_t>(array.columns),
                     {block.first, array.total},
                     block.rows,
                     block.fill};
      is_made ? file.more_rows(std::move(slab)) : file.slab(std::move(slab));
      is_made = true;
    }
    for (const Attribute& attribute : array.attributes)
      file.attribute(path, attribute);
  }
}

} // namespace trime::io
