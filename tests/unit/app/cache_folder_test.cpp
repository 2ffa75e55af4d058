#include "app/cache_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace onestroke {
namespace {

/// Sets a variable, or takes it away, and puts it back as it was.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    const char* before = std::getenv(name);
    had_ = before != nullptr;
    if (had_) before_ = before;
    set(value);
  }
  Variable(const Variable&) = delete;
  ~Variable() { set(had_ ? before_.c_str() : nullptr); }

 private:
  void set(const char* value) const {
    if (value)
      setenv(name_, value, 1);
    else
      unsetenv(name_);
  }

  const char* name_;
  bool had_ = false;
  std::string before_;
};

std::filesystem::path folder_for(const char* cache, const char* home) {
  const Variable a("XDG_CACHE_HOME", cache), b("HOME", home);
  return cache_folder();
}

TEST(CacheFolder, IsWhereTheDesktopsRulesSay) {
  EXPECT_EQ(folder_for("/caches", "/home/a"), "/caches/onestroke");
  EXPECT_EQ(folder_for(nullptr, "/home/a"), "/home/a/.cache/onestroke");
  EXPECT_EQ(folder_for("", "/home/a"), "/home/a/.cache/onestroke");
  EXPECT_EQ(folder_for("not/absolute", "/home/a"), "/home/a/.cache/onestroke");
}

TEST(StateFolder, IsWhereTheDesktopsRulesSay) {
  const Variable home("HOME", "/home/a");
  {
    const Variable state("XDG_STATE_HOME", "/states");
    EXPECT_EQ(state_folder(), "/states/onestroke");
  }
  const Variable none("XDG_STATE_HOME", nullptr);
  EXPECT_EQ(state_folder(), "/home/a/.local/state/onestroke");
}

TEST(CacheFolder, IsNoneWhereNothingNamesOne) {
  EXPECT_EQ(folder_for(nullptr, nullptr), "");
  EXPECT_EQ(folder_for("", "home"), "");
}

}  // namespace
}  // namespace onestroke
