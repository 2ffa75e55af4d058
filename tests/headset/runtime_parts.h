// What every OpenXR runtime of these tests needs.
#pragma once

#include <openxr/openxr.h>

#include <cstdint>
#include <string_view>

namespace runtime_parts {

// How a loader and a runtime shake hands; from the specification of OpenXR's loader, 1.0.
struct RuntimeRequest {
  std::uint32_t struct_type, struct_version;
  std::size_t struct_size;
  std::uint32_t interface_version;
  XrVersion api_version;
  PFN_xrGetInstanceProcAddr get_function;
};

struct Function {
  std::string_view name;
  PFN_xrVoidFunction address;
};

template <typename F>
Function named(std::string_view name, F* function) {
  return {name, reinterpret_cast<PFN_xrVoidFunction>(function)};
}

template <typename Functions>
PFN_xrVoidFunction find(const Functions& functions, std::string_view name) {
  for (const Function& f : functions)
    if (f.name == name) return f.address;
  return nullptr;
}

/// OpenXR's way to give a list: its length first.
template <typename List, typename Item>
XrResult give(const List& list, std::uint32_t capacity, std::uint32_t* count, Item* items) {
  *count = static_cast<std::uint32_t>(list.size());
  if (capacity == 0) return XR_SUCCESS;
  if (capacity < list.size()) return XR_ERROR_SIZE_INSUFFICIENT;
  for (const auto& item : list) *items++ = item;
  return XR_SUCCESS;
}

}  // namespace runtime_parts
