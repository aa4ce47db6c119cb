// expat reads the file before any other parser sees it: it is robust against broken and hostile
// XML, and it knows the line of every element. What passes here is well-formed.
#include "urdf_xml.hpp"

#include <expat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "handey/errors.hpp"

namespace handey::kinematics {
namespace {

constexpr std::uintmax_t kMostBytes = std::uintmax_t{16} << 20;
constexpr std::size_t kMostDepth = 64;

std::string read_file(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw InvalidInput("E_PATH", path, "there is no such file; expected a URDF");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw InvalidInput("E_PATH", path, "is not a regular file; expected a URDF");
  }
  if (std::filesystem::file_size(path, error) > kMostBytes || error) {
    throw InvalidInput("E_TOO_BIG", path, "is larger than 16 MiB, the most that is read");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InvalidInput("E_PATH", path, "cannot be opened for reading");
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  // The file may have grown since its size was asked.
  if (text.size() > kMostBytes) throw InvalidInput("E_TOO_BIG", path, "is larger than 16 MiB");
  return text;
}

/// Length of the well-formed UTF-8 sequence at `at` (no overlong forms, no surrogates), 0 if there
/// is none.
std::size_t utf8_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
  const unsigned lead = byte(at), second = byte(at + 1);
  if (lead < 0x80u) return lead == 0u ? 0 : 1;
  if (lead >= 0xC2u && lead <= 0xDFu) return continues(at + 1) ? 2 : 0;
  if (lead >= 0xE0u && lead <= 0xEFu) {
    const bool overlong = lead == 0xE0u && second < 0xA0u;
    const bool surrogate = lead == 0xEDu && second > 0x9Fu;
    return continues(at + 1) && continues(at + 2) && !overlong && !surrogate ? 3 : 0;
  }
  if (lead >= 0xF0u && lead <= 0xF4u) {
    const bool overlong = lead == 0xF0u && second < 0x90u;
    const bool beyond = lead == 0xF4u && second > 0x8Fu;
    const bool all = continues(at + 1) && continues(at + 2) && continues(at + 3);
    return all && !overlong && !beyond ? 4 : 0;
  }
  return 0;
}

void require_utf8(const std::string& text, const std::string& file) {
  std::size_t at = 0;
  int line = 1;
  while (at < text.size()) {
    const std::size_t length = utf8_length(text, at);
    if (length == 0) {
      throw InvalidInput(
          "E_ENCODING", file + ":" + std::to_string(line),
          "byte " + std::to_string(at) + " is not UTF-8; expected a UTF-8 file without NUL");
    }
    if (text[at] == '\n') ++line;
    at += length;
  }
}

struct Reader {
  XML_Parser parser = nullptr;
  std::unique_ptr<XmlElement> root;
  std::vector<XmlElement*> open;
  std::string code, message;  ///< why the reader stopped the parser

  void stop(const char* why_code, std::string why) {
    code = why_code;
    message = std::move(why);
    XML_StopParser(parser, XML_FALSE);
  }
};

void start_element(void* user, const XML_Char* name, const XML_Char** attributes) {
  Reader& reader = *static_cast<Reader*>(user);
  if (!reader.code.empty()) return;
  if (reader.open.size() >= kMostDepth) {
    reader.stop("E_DEPTH", "elements are nested deeper than 64 levels");
    return;
  }
  auto element = std::make_unique<XmlElement>();
  element->name = name;
  element->line = static_cast<int>(XML_GetCurrentLineNumber(reader.parser));
  for (; *attributes; attributes += 2) {
    element->attributes.emplace_back(attributes[0], attributes[1]);
  }
  XmlElement* raw = element.get();
  if (reader.open.empty()) {
    reader.root = std::move(element);
  } else {
    reader.open.back()->children.push_back(std::move(element));
  }
  reader.open.push_back(raw);
}

void end_element(void* user, const XML_Char*) {
  Reader& reader = *static_cast<Reader*>(user);
  if (!reader.open.empty()) reader.open.pop_back();
}

void character_data(void* user, const XML_Char* text, int length) {
  Reader& reader = *static_cast<Reader*>(user);
  if (reader.open.empty()) return;
  const bool blank = std::all_of(
      text, text + length, [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; });
  if (!blank) reader.open.back()->has_text = true;
}

void start_doctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int) {
  static_cast<Reader*>(user)->stop("E_DOCTYPE", "a DOCTYPE is not allowed, nor are entities");
}

void xml_declaration(void* user, const XML_Char*, const XML_Char* encoding, int) {
  if (!encoding) return;
  std::string name = encoding;
  for (char& c : name) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  if (name != "UTF-8" && name != "UTF8" && name != "US-ASCII" && name != "ASCII") {
    static_cast<Reader*>(user)->stop("E_ENCODING",
                                     "declares the encoding '" + name + "'; expected UTF-8");
  }
}

void parse(Reader& reader, const std::string& text, const std::string& file) {
  XML_SetUserData(reader.parser, &reader);
  XML_SetElementHandler(reader.parser, start_element, end_element);
  XML_SetCharacterDataHandler(reader.parser, character_data);
  XML_SetStartDoctypeDeclHandler(reader.parser, start_doctype);
  XML_SetXmlDeclHandler(reader.parser, xml_declaration);
  const XML_Status status =
      XML_Parse(reader.parser, text.data(), static_cast<int>(text.size()), XML_TRUE);
  if (status == XML_STATUS_OK) return;
  const std::string place = file + ":" + std::to_string(XML_GetCurrentLineNumber(reader.parser));
  if (!reader.code.empty()) throw InvalidInput(reader.code, place, reader.message);
  throw InvalidInput(
      "E_XML", place,
      std::string("is not well-formed XML: ") + XML_ErrorString(XML_GetErrorCode(reader.parser)));
}

}  // namespace

const std::string* XmlElement::attribute(const std::string& key) const {
  for (const auto& [name_, value_] : attributes) {
    if (name_ == key) return &value_;
  }
  return nullptr;
}

std::string XmlElement::value(const std::string& key) const {
  const std::string* found = attribute(key);
  return found ? *found : std::string();
}

const XmlElement* XmlElement::child(const std::string& tag) const {
  for (const auto& element : children) {
    if (element->name == tag) return element.get();
  }
  return nullptr;
}

std::vector<const XmlElement*> XmlElement::all(const std::string& tag) const {
  std::vector<const XmlElement*> found;
  for (const auto& element : children) {
    if (element->name == tag) found.push_back(element.get());
  }
  return found;
}

XmlDocument read_xml(const std::string& path) {
  XmlDocument document;
  document.text = read_file(path);
  const std::string file = std::filesystem::path(path).filename().string();
  require_utf8(document.text, file);
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
      XML_ParserCreate("UTF-8"), &XML_ParserFree);
  if (!parser) throw std::bad_alloc();
  Reader reader;
  reader.parser = parser.get();
  parse(reader, document.text, file);
  document.root = std::move(reader.root);
  return document;
}

}  // namespace handey::kinematics
