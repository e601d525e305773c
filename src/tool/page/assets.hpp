// The files that a page is made of, embedded by the build: embed_page.cmake writes their definitions.
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace isostep::tool::page::assets {

extern const std::string_view kPage;      // page.html
extern const std::string_view kStyle;     // player.css
extern const std::string_view kScript;    // decode.js, surfaces.js, ...: see embed_page.cmake
extern const std::string_view kThree;     // three.js, minified; empty where it could not be had
extern const std::string_view kBuildDir;  // where the build lies

}  // namespace isostep::tool::page::assets
