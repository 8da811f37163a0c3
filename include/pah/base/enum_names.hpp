// Names of an enumeration's values, kept in a table beside it.
#pragma once

#include <span>

namespace pah {

template <typename Enum>
struct EnumName {
  Enum value;
  const char* key;    // in scene files
  const char* label;  // in reports
};

// The label of a value; empty if the table lacks it.
template <typename Enum>
[[nodiscard]] constexpr const char* label_of(std::span<const EnumName<Enum>> names, Enum value) {
  for (const EnumName<Enum>& name : names)
    if (name.value == value) return name.label;
  return "";
}

}  // namespace pah
