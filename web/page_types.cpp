// Writes the page's types, src/page_types.ts, from the tables of fields: target page_types.

#include <fmt/format.h>

#include "dashboard/page_fields.hpp"

int main() { fmt::print("{}", nacre::dashboard::page_types()); }
