#pragma once
// The manual page, made of what --help shows.

#include <string>

#include <CLI/CLI.hpp>

namespace panache::cli {

// A hidden argument, used by the build: prints the manual page.
inline constexpr const char* kPrintManualPage = "--print-manual-page";

// In roff, with the macros of man(7).
std::string manual_page(const CLI::App& program, const std::string& version);

}  // namespace panache::cli
