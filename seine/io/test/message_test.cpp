#include "seine/io/message.hpp"

#include <gtest/gtest.h>

namespace seine::io {
namespace {

TEST(Message, PrintsWhatCanBePrinted) {
  EXPECT_EQ(printable("plain", 40), "plain");
  EXPECT_EQ(printable("Straße 車", 40), "Straße 車");
  EXPECT_EQ(printable("a\x1b[31m\n\x7f", 40), "a?[31m??");
  EXPECT_EQ(printable("\xff\xc0\x80\xed\xa0\x80\xc2\x9b", 40), "????????");
}

TEST(Message, LeavesOutTheMiddle) {
  const std::string shown = printable(std::string(1000, 'a') + "end", 40);
  EXPECT_LE(shown.size(), 43U);
  EXPECT_TRUE(shown.ends_with("aend"));
  std::string wide;
  for (int i = 0; i < 100; ++i) wide += "車";
  EXPECT_EQ(printable(wide, 40).find('?'), std::string::npos);
}

}  // namespace
}  // namespace seine::io
