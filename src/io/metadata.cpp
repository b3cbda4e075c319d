// SPDX-License-Identifier: BSD-3-Clause
#include "trime/io/metadata.hpp"

#include "trime/core/error.hpp"

#include <cstring>
#include <type_traits>

namespace trime::io {
namespace {

/// Appends values to a text of bytes.
class Packer {
public:
  void operator()(const std::string& text) {
    (*this)(text.size());
    bytes_ += text;
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(T value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
  template <class T>
  void operator()(const std::vector<T>& values) {
    (*this)(values.size());
    for (const T& value : values)
      (*this)(value);
  }
  template <class... T>
  void operator()(const std::variant<T...>& value) {
    (*this)(value.index());
    std::visit([this](const auto& held) { (*this)(held); }, value);
  }
  void operator()(const Attribute& a) { both(a.name, a.value); }
  void operator()(const Column& c) { both(c.name, c.values); }
  void operator()(const Text& t) { both(t.name, t.text); }
  void operator()(const MetadataGroup& g) {
    (*this)(g.name);
    both(g.attributes, g.columns);
  }
  std::string take() { return std::move(bytes_); }

private:
  template <class A, class B>
  void both(const A& a, const B& b) {
    (*this)(a);
    (*this)(b);
  }
  std::string bytes_;
};

/// Takes the values from the text in the same order.
class Unpacker {
public:
  explicit Unpacker(std::string bytes) : bytes_(std::move(bytes)) {}

  void operator()(std::string& text) {
    text = bytes_.substr(position_, size());
    position_ += text.size();
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(T& value) {
    TRIME_ASSERT(position_ + sizeof value <= bytes_.size());
    std::memcpy(&value, bytes_.data() + position_, sizeof value);
    position_ += sizeof value;
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    values.resize(size());
    for (T& value : values)
      (*this)(value);
  }
  template <class... T>
  void operator()(std::variant<T...>& value) {
    choose<0>(value, size());
  }
  void operator()(Attribute& a) { both(a.name, a.value); }
  void operator()(Column& c) { both(c.name, c.values); }
  void operator()(Text& t) { both(t.name, t.text); }
  void operator()(MetadataGroup& g) {
    (*this)(g.name);
    both(g.attributes, g.columns);
  }

private:
  std::size_t size() {
    std::size_t value = 0;
    (*this)(value);
    return value;
  }
  template <std::size_t I, class V>
  void choose(V& variant, std::size_t index) {
    if constexpr (I < std::variant_size_v<V>) {
      if (index == I)
        (*this)(variant.template emplace<I>());
      else
        choose<I + 1>(variant, index);
    }
  }
  template <class A, class B>
  void both(A& a, B& b) {
    (*this)(a);
    (*this)(b);
  }
  std::string bytes_;
  std::size_t position_ = 0;
};

} // namespace

std::string shortened(const std::string& text, std::size_t longest) {
  if (text.size() <= longest)
    return text;
  std::size_t kept = longest - 3;
  while (kept > 0 && (static_cast<unsigned char>(text[kept]) & 0xc0) == 0x80) // in the middle of a character
    --kept;
  return text.substr(0, kept) + "...";
}

Metadata broadcast(const Metadata& metadata, const comm::Communicator& comm) {
  if (comm.size() == 1)
    return metadata;
  Packer pack;
  if (comm.is_root()) {
    pack(metadata.attributes);
    pack(metadata.texts);
    pack(metadata.groups);
  }
  Unpacker unpack(comm.broadcast(pack.take()));
  Metadata result;
  unpack(result.attributes);
  unpack(result.texts);
  unpack(result.groups);
  return result;
}

const MetadataGroup* find_group(const Metadata& metadata, const std::string& name) {
  for (const MetadataGroup& group : metadata.groups)
    if (group.name == name)
      return &group;
  return nullptr;
}

template <class T>
const T& attribute_of(const Metadata& metadata, const std::string& name) {
  for (const Attribute& attribute : metadata.attributes)
    if (attribute.name == name && std::holds_alternative<T>(attribute.value))
      return std::get<T>(attribute.value);
  throw FileError(fmt::format("the mesh file has no attribute /trime_mpi/{} of the expected type", name));
}
template const std::int64_t& attribute_of(const Metadata&, const std::string&);
template const std::uint64_t& attribute_of(const Metadata&, const std::string&);
template const double& attribute_of(const Metadata&, const std::string&);
template const std::string& attribute_of(const Metadata&, const std::string&);

template <class T>
const std::vector<T>& column_of(const Metadata& metadata, const std::string& group, const std::string& name) {
  if (const MetadataGroup* found = find_group(metadata, group))
    for (const Column& column : found->columns)
      if (column.name == name && std::holds_alternative<std::vector<T>>(column.values))
        return std::get<std::vector<T>>(column.values);
  throw FileError(fmt::format("the mesh file has no column /trime_mpi/{}/{} of the expected type", group, name));
}
template const std::vector<std::int32_t>& column_of(const Metadata&, const std::string&, const std::string&);
template const std::vector<std::int64_t>& column_of(const Metadata&, const std::string&, const std::string&);
template const std::vector<double>& column_of(const Metadata&, const std::string&, const std::string&);
template const std::vector<std::string>& column_of(const Metadata&, const std::string&, const std::string&);

std::vector<std::string> curve_names(const Metadata& metadata) {
  return find_group(metadata, "curves") == nullptr ? std::vector<std::string>()
                                                   : column_of<std::string>(metadata, "curves", "curve_name");
}

std::vector<std::string> interface_names(const Metadata& metadata) {
  return has_regions(metadata) ? column_of<std::string>(metadata, "interfaces", "pair_name")
                               : std::vector<std::string>();
}

bool has_regions(const Metadata& metadata) {
  return find_group(metadata, "interfaces") != nullptr;
}

} // namespace trime::io
