// The kind of asset that a file is decides which importer its .meta names.
// SPDX-License-Identifier: MIT
#include "metas.hpp"

#include <cinttypes>
#include <cstdio>
#include <map>
#include <set>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace isostep::csharp {
namespace {

namespace fs = std::filesystem;

std::string guid_of(const std::string& path) {
  const std::string text = "com.isostep.physics/" + path;
  const XXH128_hash_t digest = XXH3_128bits(text.data(), text.size());
  char guid[33];
  std::snprintf(guid, sizeof guid, "%016" PRIx64 "%016" PRIx64, static_cast<std::uint64_t>(digest.high64),
                static_cast<std::uint64_t>(digest.low64));
  return guid;
}

/// The end that all importers share, as Unity writes it.
const char* const kEnd = "  userData: \n  assetBundleName: \n  assetBundleVariant: \n";

std::string importer(const std::string& name, const std::string& between = "") {
  return name + ":\n  externalObjects: {}\n" + between + kEnd;
}

/// A folder of Runtime/Plugins, Unity's name of its platform, and the processor there.
struct Platform {
  std::string name, cpu;
  bool in_editor;
};
const std::map<std::string, Platform>& platforms() {
  static const std::map<std::string, Platform> all = {{"linux-x86_64", {"Standalone: Linux64", "x86_64", true}},
                                                      {"windows-x86_64", {"Standalone: Win64", "x86_64", true}},
                                                      {"macos", {"Standalone: OSXUniversal", "AnyCPU", true}},
                                                      {"android-arm64", {"Android: Android", "ARM64", false}},
                                                      {"ios", {"iPhone: iOS", "AnyCPU", false}},
                                                      {"web", {"WebGL: WebGL", "AnyCPU", false}}};
  return all;
}
std::string enabled(const std::string& platform, bool on, const std::string& settings) {
  return "  - first:\n      " + platform + "\n    second:\n      enabled: " + (on ? "1" : "0") +
         "\n      settings:" + (settings.empty() ? " {}\n" : "\n        " + settings + "\n");
}
std::string plugin_importer(const fs::path& path) {
  const std::string folder = path.parent_path().filename().string();
  const auto found = platforms().find(folder);
  std::string text =
      "  serializedVersion: 2\n  iconMap: {}\n  executionOrder: {}\n  defineConstraints: []\n"
      "  isPreloaded: 0\n  isOverridable: 0\n  isExplicitlyReferenced: 0\n  validateReferences: 1\n"
      "  platformData:\n" +
      enabled("Any: ", false, "");
  if (found != platforms().end()) {
    text += enabled("Editor: Editor", found->second.in_editor, "CPU: " + found->second.cpu);
    text += enabled(found->second.name, true, "CPU: " + found->second.cpu);
  }
  return importer("PluginImporter", text);
}

std::string importer_of(const fs::path& path, bool is_folder) {
  static const std::set<std::string> plugins = {".so", ".dll", ".dylib", ".a"}, texts = {".md", ".txt", ".json"};
  const std::string kind = path.extension().string();
  if (is_folder) return "folderAsset: yes\n" + importer("DefaultImporter");
  if (path == "package.json") return importer("PackageManifestImporter");
  if (kind == ".cs") {
    return importer("MonoImporter",
                    "  serializedVersion: 2\n  defaultReferences: []\n  executionOrder: 0\n"
                    "  icon: {instanceID: 0}\n");
  }
  if (kind == ".asmdef") return importer("AssemblyDefinitionImporter");
  if (plugins.count(kind) != 0) return plugin_importer(path);
  if (texts.count(kind) != 0) return importer("TextScriptImporter");
  return importer("DefaultImporter");
}

/// Unity does not look into folders whose names end in ~; samples are copied out of theirs, with their metas.
bool has_meta(const fs::path& path) {
  for (const fs::path& part : path) {
    const std::string name = part.string();
    if (name.front() == '.') return false;
    if (name.back() == '~' && (name != "Samples~" || path == part)) return false;
  }
  return path.extension() != ".meta";
}

}  // namespace

void write_metas(const fs::path& package) {
  Files metas;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(package)) {
    const fs::path path = fs::relative(entry.path(), package);
    const std::string name = path.generic_string();
    if (!has_meta(path)) continue;
    metas[name + ".meta"] =
        "fileFormatVersion: 2\nguid: " + guid_of(name) + "\n" + importer_of(name, entry.is_directory());
  }
  write_files(package, metas);
}

}  // namespace isostep::csharp
