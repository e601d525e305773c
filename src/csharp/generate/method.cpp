// The arguments of a function together decide which values C# passes and returns.
// SPDX-License-Identifier: MIT
#include "method.hpp"

#include <algorithm>
#include <map>

#include "functions.hpp"
#include "names.hpp"

namespace isostep::csharp {

/// The function's name without iso_ and the family's prefix.
std::string short_name(const Function& function) { return function.name.substr(function.family.empty() ? 4 : 8); }

bool starts(const std::string& text, const std::string& with) { return text.compare(0, with.size(), with) == 0; }
bool ends(const std::string& text, const std::string& with) {
  return text.size() >= with.size() && text.compare(text.size() - with.size(), with.size(), with) == 0;
}

namespace {

bool may_be_null(const std::string& function, const std::string& argument) {
  if (argument == "mass") return function == "body_set_type" || function == "body_set_shape";
  return argument == "torque" || argument == "angular_impulse";
}

/// The method's name: "iso_body_get_state" is GetBodyState, "iso_world_get_counts" of a world GetCounts.
std::string method_name(const Function& function, const std::string& handle) {
  static const std::map<std::string, std::string> own = {
      {"body_move_to", "MoveBodyTo"},      {"world_poses", "Poses"},
      {"joint_set", "SetJoint"},           {"joint_get", "GetJoint"},
      {"bodies_destroy", "DestroyBodies"}, {"session_input", "GetInput"},
      {"session_phase", "Phase"},          {"blob_get_type", "GetShapeType"}};
  std::string name = short_name(function);
  const auto found = own.find(name);
  if (found != own.end()) return found->second;
  if (!handle.empty() && starts(name, handle.substr(4) + "_")) name = name.substr(handle.size() - 3);
  for (const std::string noun : {"body", "joint", "shape"}) {
    if (!starts(name, noun + "_")) continue;
    const std::string rest = name.substr(noun.size() + 1);
    if (starts(rest, "apply_")) return pascal(rest);
    for (const std::string verb : {"get", "set", "create", "destroy", "wake", "sleep"}) {
      if (rest == verb) return pascal(verb + "_" + noun);
      if (starts(rest, verb + "_")) return pascal(verb + "_" + noun + "_" + rest.substr(verb.size() + 1));
    }
  }
  return pascal(name);
}

/// One method as it grows: parameters, lines before the call, arguments, the result.
class Method {
 public:
  Method(const Function& function, const Schema& schema, const std::string& handle)
      : function_(function), schema_(schema), handle_(handle) {}

  /// The method's text, empty where some argument's meaning is not known.
  std::string text() {
    const bool is_static = handle_.empty();
    for (at_ = is_static ? 0 : 1; at_ < function_.arguments.size();) {
      if (!take()) return "";
    }
    const std::string passed = (is_static ? "" : std::string("Pointer") + (passed_.empty() ? "" : ", ")) + passed_;
    const std::string call = "Native." + function_.name + "(" + passed + ")";
    return summary(function_.comment, kIndent) + (is_view_ ? view_text(call) : method_text(call));
  }
  /// The struct that a view shows, "" of other methods.
  const std::string& viewed() const { return viewed_; }

 private:
  static constexpr const char* kIndent = "        ";

  const Argument& argument(std::size_t ahead = 0) const {
    static const Argument none;
    return at_ + ahead < function_.arguments.size() ? function_.arguments[at_ + ahead] : none;
  }
  std::string native(const std::string& type) const { return native_type(type, function_.family, schema_, false); }
  bool is_handle(const std::string& type) const {
    const std::string base = base_of(type);
    return std::find(schema_.handles.begin(), schema_.handles.end(), base) != schema_.handles.end();
  }
  static std::string base_of(std::string type) {
    if (starts(type, "const ")) type = type.substr(6);
    return type.substr(0, type.find_first_of("* "));
  }
  bool is_sized(const std::string& type) const {
    const Struct* made = schema_.find(base_of(type));
    return made != nullptr && made->sized;
  }

  void parameter(const std::string& text) { parameters_ += (parameters_.empty() ? "" : ", ") + text; }
  void pass(const std::string& text) { passed_ += (passed_.empty() ? "" : ", ") + text; }
  void before(const std::string& text) { before_ += std::string(kIndent) + "    " + text + "\n"; }
  void fix(const std::string& text) { fixed_ += std::string(kIndent) + "    fixed (" + text + ")\n"; }

  bool take() {
    const Argument& first = argument();
    const std::string& type = first.type;
    const bool is_const = starts(type, "const ");
    const std::string name = camel(first.name);
    if (type == "const void*" && argument(1).type == "size_t") return take_array("byte", name);
    if (type == "void*" && argument(1).type == "size_t*") return take_bytes_out();
    if (type == "const void**" && argument(1).type == "size_t*") return take_bytes_seen();
    if (is_const && ends(type, "**") && argument(1).type == "size_t*") return take_view();
    if (ends(type, "**") || starts(type, "char") || type == "void*" || type == "iso_run") return false;
    if (!is_const && ends(type, "*") && argument(1).type == "size_t" && argument(2).type == "size_t*")
      return take_list();
    if (!is_const && ends(type, "*") && argument(1).name == "found") return take_found();
    if (is_handle(type)) return take_handle(name);
    if (is_const && type != "const char*" && ends(type, "*") && argument(1).type == "size_t" &&
        argument(1).name == "count")
      return take_array(element(type), name);
    if (type == "const char*") return take_text(name);
    if (is_const && ends(type, "*")) return take_struct(name);
    if (ends(type, "*")) return take_out(name);
    return take_value(name);
  }
  std::string element(const std::string& type) const {
    const std::string with_star = native(type);
    return with_star.substr(0, with_star.size() - 1);
  }

  bool take_array(const std::string& of, const std::string& name) {
    parameter(of + "[] " + name);
    fix(of + "* " + camel(function_.arguments[at_].name + "_at") + " = " + name);
    pass(camel(function_.arguments[at_].name + "_at"));
    pass("NativeText.Length(" + name + ")");
    at_ += 2;
    return true;
  }
  bool take_bytes_out() {
    before("UIntPtr size = UIntPtr.Zero;");
    pass("bytes");
    pass("&size");
    returns_ = "byte[]";
    two_calls_ = true;
    at_ += 2;
    return true;
  }
  bool take_bytes_seen() {
    before("void* bytes;");
    before("UIntPtr size;");
    pass("&bytes");
    pass("&size");
    returns_ = "byte[]";
    result_ = "NativeText.Copy(bytes, size)";
    at_ += 2;
    return true;
  }
  bool take_view() {
    const std::string with_stars = native(argument().type);
    viewed_ = with_stars.substr(0, with_stars.size() - 2);
    before(viewed_ + "* first;");
    before("UIntPtr count;");
    pass("&first");
    pass("&count");
    is_view_ = true;
    at_ += 2;
    return true;
  }
  bool take_list() {
    const std::string of = element(argument().type), name = camel(argument().name == "out" ? "found" : argument().name);
    parameter(of + "[] " + name);
    before("UIntPtr count;");
    fix(of + "* at = " + name);
    pass("at");
    pass("NativeText.Length(" + name + ")");
    pass("&count");
    returns_ = "int";
    result_ = "(int)count";
    small_is_fine_ = true;
    at_ += 3;
    return true;
  }
  bool take_found() {
    const std::string of = element(argument().type);
    parameter("out " + of + " hit");
    before(of + " filled;");
    before("byte found;");
    pass("&filled");
    pass("&found");
    after_ = std::string(kIndent) + "    hit = filled;\n";
    returns_ = "bool";
    result_ = "found != 0";
    at_ += 2;
    return true;
  }
  bool take_handle(const std::string& name) {
    if (ends(argument().type, "**") || argument().type.find("* const*") != std::string::npos) return false;
    parameter((base_of(argument().type) == "iso_world" ? "WorldBase" : type_name(base_of(argument().type))) + " " +
              name);
    pass(name + " == null ? IntPtr.Zero : " + name + ".Pointer");
    ++at_;
    return true;
  }
  bool take_text(const std::string& name) {
    parameter("string " + name);
    fix("byte* " + name + "At = NativeText.Bytes(" + name + ")");
    pass(name + "At");
    ++at_;
    return true;
  }
  bool take_struct(const std::string& name) {
    const std::string of = element(argument().type);
    if (may_be_null(short_name(function_), argument().name)) {
      parameter(of + "? " + name + " = null");
      before(of + " " + name + "Value = " + name + ".GetValueOrDefault();");
      pass(name + ".HasValue ? &" + name + "Value : null");
    } else {
      parameter(of + " " + name);
      pass("&" + name);
    }
    ++at_;
    return true;
  }
  bool take_out(const std::string& name) {
    const std::string of = element(argument().type);
    const bool is_last = at_ + 1 == function_.arguments.size();
    const bool is_number = of == "UIntPtr";
    if (!is_last || !returns_.empty()) {  // one of several
      parameter("out " + std::string(is_number ? "int" : of) + " " + name);
      before(of + " " + name + "Value" + (is_sized(argument().type) ? " = " + of + ".Sized();" : ";"));
      pass("&" + name + "Value");
      after_ += std::string(kIndent) + "    " + name + " = " + (is_number ? "(int)" : "") + name + "Value;\n";
    } else {
      before(of + " filled" + (is_sized(argument().type) ? " = " + of + ".Sized();" : ";"));
      pass("&filled");
      returns_ = is_number ? "int" : of == "byte" ? "bool" : of;
      result_ = is_number ? "(int)filled" : of == "byte" ? "filled != 0" : "filled";
    }
    ++at_;
    return true;
  }
  bool take_value(const std::string& name) {
    const std::string& type = argument().type;
    const std::string plain = native(type);
    const Family* family = find_family(function_.family);
    const bool is_id = type == "iso_body" || type == "iso_shape" || type == "iso_joint" || type == "iso_record";
    const bool is_fixed = family != nullptr && family->number.front() == 'Q' && !starts(argument().name, "teeth") &&
                          type == (family->number == "Q16" ? "int32_t" : "int64_t");
    if (is_id) {
      parameter(type_name(type) + " " + name);
      pass(name + ".Value");
    } else if (is_fixed) {
      parameter(family->number + " " + name);
      pass(name + ".Raw");
    } else if (type == "uint8_t") {
      parameter("bool " + name);
      pass("(byte)(" + name + " ? 1 : 0)");
    } else if (type == "size_t") {
      parameter("int " + name);
      pass("(UIntPtr)" + name);
    } else {
      parameter(plain + " " + name);
      pass(name);
    }
    ++at_;
    return true;
  }

  std::string wrapped(const std::string& line, const std::string& indent) const {
    if (line.size() <= 120) return line + "\n";
    std::size_t at = line.rfind(", ", 118);
    if (at == std::string::npos) return line + "\n";
    return line.substr(0, at + 1) + "\n" + wrapped(indent + line.substr(at + 2), indent);
  }
  std::string check(const std::string& call, const std::string& indent) const {
    const std::string checked = small_is_fine_ ? "CheckList(" : "Check(";
    const std::string by = handle_.empty() ? "IsostepException." : "";
    return wrapped(indent + by + checked + call + ");", indent + "    ");
  }

  std::string method_text(const std::string& call) {
    const std::string name = method_name(function_, handle_), indent = kIndent;
    const std::string plain = native(function_.returns);
    const std::string modifier = handle_.empty() ? "public static " : "public ";
    if (plain != "Status") {
      const std::string returned = plain == "byte*" ? "string" : plain == "byte" ? "bool" : plain;
      const std::string value = plain == "byte*"  ? "NativeText.Read(" + call + ")"
                                : plain == "byte" ? call + " != 0"
                                                  : call;
      if (parameters_.empty())
        return indent + modifier + returned + " " + name + " { get { return " + value + "; } }\n";
      return wrapped(indent + modifier + returned + " " + name + "(" + parameters_ + ")", indent + "    ") + indent +
             "{\n" + before_ + fixed_ + wrapped(indent + "    return " + value + ";", indent + "        ") + indent +
             "}\n";
    }
    std::string text =
        wrapped(indent + modifier + (returns_.empty() ? "void" : returns_) + " " + name + "(" + parameters_ + ")",
                indent + "    ") +
        indent + "{\n" + before_;
    if (two_calls_) {
      std::string first = call;
      first.replace(first.find("bytes"), 5, "null");
      text += fixed_ + indent + "    CheckList(" + first + ");\n" + indent +
              "    byte[] result = new byte[(int)size];\n" + indent + "    if (result.Length == 0) return result;\n" +
              indent + "    fixed (byte* bytes = result)\n" + check(call, indent + "        ") + indent +
              "    return result;\n";
    } else {
      text += fixed_ + check(call, indent + (fixed_.empty() ? "    " : "        ")) + after_;
      if (!returns_.empty()) text += indent + "    return " + result_ + ";\n";
    }
    return text + indent + "}\n";
  }
  std::string view_text(const std::string& call) {
    const std::string indent = kIndent, name = method_name(function_, handle_), view = viewed_ + "View";
    const std::string body =
        before_ + check(call, indent + "    ") + indent + "    return new " + view + "(this, first, (int)count);\n";
    if (!parameters_.empty()) {
      return indent + "public " + view + " " + name + "(" + parameters_ + ")\n" + indent + "{\n" + body + indent +
             "}\n";
    }
    std::string inner;
    for (std::size_t from = 0; from < body.size();) {
      const std::size_t end = body.find('\n', from) + 1;
      inner += "    " + body.substr(from, end - from);
      from = end;
    }
    return indent + "public " + view + " " + name + "\n" + indent + "{\n" + indent + "    get\n" + indent + "    {\n" +
           inner + indent + "    }\n" + indent + "}\n";
  }

  const Function& function_;
  const Schema& schema_;
  std::string handle_;
  std::size_t at_ = 0;
  std::string parameters_, before_, fixed_, passed_, after_, returns_, result_, viewed_;
  bool is_view_ = false, two_calls_ = false, small_is_fine_ = false;
};

}  // namespace

MadeMethod make_method(const Function& function, const Schema& schema, const std::string& handle) {
  Method method(function, schema, handle);
  std::string text = method.text();
  return {std::move(text), method.viewed()};
}

}  // namespace isostep::csharp
