// A table on disk: a header of 64 bytes, then the maps. Nothing in a file is trusted: magic, key,
// length and the sums of header and content must fit, else the table is made anew.
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <random>
#include <system_error>

#include "arm_table_impl.hpp"

namespace handey::cspace {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMagic = 0x3154594548444e41;  // also tells the order of bytes

struct Header {
  std::uint64_t magic = kMagic;
  std::uint64_t key[2] = {0, 0};
  std::uint64_t length = 0;   ///< of the content [bytes]
  std::uint64_t content = 0;  ///< its sum
  std::uint64_t rest[2] = {0, 0};
  std::uint64_t header = 0;  ///< sum of the words before
};
static_assert(sizeof(Header) == 64);

std::uint64_t sum_of(const std::uint8_t* bytes, std::size_t size) {
  std::uint64_t sum = 0xcbf29ce484222325;
  std::size_t at = 0;
  for (; at + 8 <= size; at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + at, 8);
    sum = (sum ^ word) * 0x9e3779b97f4a7c15;
    sum ^= sum >> 32;
  }
  for (; at < size; ++at) sum = (sum ^ bytes[at]) * 0x100000001b3;
  return sum;
}

std::uint64_t sum_of(const Header& header) {
  return sum_of(reinterpret_cast<const std::uint8_t*>(&header), offsetof(Header, header));
}

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

fs::path path_of(const std::string& directory, const ContentKey& key) {
  char name[64];
  std::snprintf(name, sizeof(name), "arm-%016llx%016llx.table",
                static_cast<unsigned long long>(key[0]), static_cast<unsigned long long>(key[1]));
  return fs::path(directory) / name;
}

}  // namespace

bool read_table(const std::string& directory, const ContentKey& key, std::size_t size,
                std::vector<std::uint8_t>& bytes) {
  const File file(std::fopen(path_of(directory, key).string().c_str(), "rb"));
  if (file == nullptr) return false;
  Header header;
  if (std::fread(&header, sizeof(header), 1, file.get()) != 1) return false;
  if (header.magic != kMagic || header.key[0] != key[0] || header.key[1] != key[1] ||
      header.length != size || header.header != sum_of(header)) {
    return false;
  }
  std::vector<std::uint8_t> content(size);
  if (std::fread(content.data(), 1, size, file.get()) != size || std::fgetc(file.get()) != EOF ||
      sum_of(content.data(), size) != header.content) {
    return false;
  }
  bytes = std::move(content);
  return true;
}

void write_table(const std::string& directory, const ContentKey& key,
                 const std::vector<std::uint8_t>& bytes) {
  std::error_code ignored;
  fs::create_directories(directory, ignored);
  const fs::path path = path_of(directory, key);
  // A name aside that no other writer has; exclusive, should chance have it otherwise.
  fs::path aside = path;
  aside += "." + std::to_string(std::random_device()()) + ".part";
  {
    const File file(std::fopen(aside.string().c_str(), "wbx"));
    if (file == nullptr) return;
    Header header;
    header.key[0] = key[0];
    header.key[1] = key[1];
    header.length = bytes.size();
    header.content = sum_of(bytes.data(), bytes.size());
    header.header = sum_of(header);
    const bool written = std::fwrite(&header, sizeof(header), 1, file.get()) == 1 &&
                         std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() &&
                         std::fflush(file.get()) == 0;
    if (!written) {
      fs::remove(aside, ignored);
      return;
    }
  }
  fs::rename(aside, path, ignored);
  if (ignored) fs::remove(aside, ignored);
}

}  // namespace handey::cspace
