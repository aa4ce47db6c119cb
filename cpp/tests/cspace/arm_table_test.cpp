#include "handey/cspace/arm_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "../../src/cspace/arm_table_impl.hpp"
#include "../collision/puma_cell.hpp"
#include "handey/errors.hpp"

namespace handey {
namespace {

namespace fs = std::filesystem;

/// A folder that is gone with the test.
class Folder {
 public:
  Folder() {
    path_ = fs::temp_directory_path() /
            ("handey_table_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)) + "_" +
             ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  std::string name() const { return path_.string(); }
  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    if (!fs::exists(path_)) return found;
    for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
      found.push_back(entry.path());
    }
    return found;
  }

 private:
  fs::path path_;
};

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

const std::vector<std::uint8_t>& maps_of(const std::shared_ptr<const ArmTable>& table) {
  return table->impl().bytes;
}

TEST(ArmTable, TakesTheLatticeOfTheRobot) {
  const std::shared_ptr<const ArmTable> table = make_arm_table(*testing::puma());
  ASSERT_NE(table, nullptr);
  EXPECT_EQ(table->level(), 0);
  EXPECT_EQ(table->lattice().cells(0, 0), 40);
  EXPECT_EQ(table->lattice().cells(0, 1), 34);
}

TEST(ArmTable, IsTheSameReadAsMade) {
  Folder folder;
  ArmTableOptions options;
  options.directory = folder.name();
  const std::vector<std::uint8_t> made = maps_of(make_arm_table(*testing::puma(), options));
  ASSERT_GT(std::count_if(made.begin(), made.end(), [](std::uint8_t byte) { return byte != 0; }),
            10000);
  ASSERT_EQ(folder.files().size(), 1u);
  const std::string before = content(folder.files().front());
  const fs::file_time_type written = fs::last_write_time(folder.files().front());
  const std::vector<std::uint8_t> read = maps_of(make_arm_table(*testing::puma(), options));
  EXPECT_EQ(made, read);
  EXPECT_EQ(content(folder.files().front()), before);
  EXPECT_EQ(fs::last_write_time(folder.files().front()), written) << "it was made anew";
  EXPECT_EQ(made, maps_of(make_arm_table(*testing::puma())));
}

TEST(ArmTable, ASpoiledFileIsMadeAnew) {
  Folder folder;
  ArmTableOptions options;
  options.directory = folder.name();
  make_arm_table(*testing::puma(), options);
  const fs::path file = folder.files().front();
  const std::string good = content(file);
  ASSERT_GT(good.size(), 10000u);
  const auto spoil = [&](const std::string& bytes) {
    write(file, bytes);
    const std::shared_ptr<const ArmTable> table = make_arm_table(*testing::puma(), options);
    ASSERT_NE(table, nullptr);
    EXPECT_EQ(content(file), good);
  };
  spoil("");
  spoil(good.substr(0, 40));
  spoil(good.substr(0, good.size() - 1));
  spoil(good + "x");
  for (const std::size_t at :
       {std::size_t{3}, std::size_t{9}, std::size_t{25}, std::size_t{33}, std::size_t{60},
        std::size_t{64}, good.size() / 2, good.size() - 1}) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    spoil(bytes);
  }
}

TEST(ArmTable, AnotherRobotOrOptionHasAnotherFile) {
  Folder folder;
  ArmTableOptions options;
  options.directory = folder.name();
  make_arm_table(*testing::puma(), options);
  EXPECT_EQ(folder.files().size(), 1u);
  Robot longer = *testing::puma();
  longer.joints[2].X_PJ.translation().x() += 1e-6;
  make_arm_table(longer, options);
  EXPECT_EQ(folder.files().size(), 2u);
  Robot thicker = *testing::puma();
  thicker.bodies[4].shapes[0].geometry = Box{{0.1, 0.1, 0.1}};
  make_arm_table(thicker, options);
  EXPECT_EQ(folder.files().size(), 3u);
  options.square = 0.03;
  make_arm_table(*testing::puma(), options);
  EXPECT_EQ(folder.files().size(), 4u);
}

TEST(ArmTable, AFolderThatCannotBeWrittenIsNoError) {
  Folder folder;
  fs::create_directories(folder.name());
  write(fs::path(folder.name()) / "file", "not a folder");
  ArmTableOptions options;
  options.directory = folder.name() + "/file/below";
  EXPECT_NE(make_arm_table(*testing::puma(), options), nullptr);
}

TEST(ArmTable, SaysWhyAnArmHasNone) {
  Robot skew = *testing::puma();
  skew.joints[2].X_PJ.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()));
  std::string reason;
  EXPECT_EQ(make_arm_table(skew, {}, &reason), nullptr);
  EXPECT_NE(reason.find("parallel"), std::string::npos) << reason;
}

TEST(ArmTable, RefusesOptionsOutOfRange) {
  for (const auto& [level, square] :
       {std::pair<int, double>{-1, 0.02}, {4, 0.02}, {0, 0.0}, {0, std::nan("")}, {0, 1.0}}) {
    ArmTableOptions options;
    options.level = level;
    options.square = square;
    EXPECT_THROW(make_arm_table(*testing::puma(), options), InvalidInput);
  }
}

}  // namespace
}  // namespace handey
