#include <algorithm>

#include "seine/io/image.hpp"
#include "seine/io/message.hpp"

namespace seine::io {
namespace {

/// Walks over a PGM's header, and over the pixels of a text PGM.
class PgmReader {
 public:
  PgmReader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  /// The next whole number after blanks and comments ('#' to the end of the line).
  int next(const char* what, int least, int most) {
    skip_blanks();
    const std::size_t begin = at_;
    long value = 0;
    while (at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9') {
      value = std::min(10L * value + (bytes_[at_++] - '0'), 1'000'000'000L);
    }
    if (at_ == begin) fail(std::string("has no ") + what + " where a whole number was expected");
    if (value < least || value > most) {
      fail(std::string("has ") + what + " " + std::to_string(value) + ", expected " + std::to_string(least) +
           " to " + std::to_string(most));
    }
    return static_cast<int>(value);
  }

  /// What follows the one blank after the header.
  std::string_view raster() const { return bytes_.substr(std::min(bytes_.size(), at_ + 1)); }

  [[noreturn]] void fail(const std::string& message) const { throw complaint(file_, line_, message); }

 private:
  void skip_blanks() {
    for (bool comment = false; at_ < bytes_.size(); ++at_) {
      const char c = bytes_[at_];
      if (c == '\n') ++line_, comment = false;
      if (c == '#') comment = true;
      const bool blank = c == ' ' || c == '\n' || c == '\r' || c == '\t';
      if (!comment && !blank) return;
    }
  }

  std::string_view bytes_;
  const std::string& file_;
  std::size_t at_ = 2;  // after "P5"
  int line_ = 1;
};

void read_raster(std::string_view raster, const PgmReader& reader, GreyImage& image) {
  const std::size_t depth = image.white > 255 ? 2 : 1, pixels = image.pixels();
  if (raster.size() < depth * pixels) {
    reader.fail("ends after " + std::to_string(raster.size() / depth) + " of " + std::to_string(pixels) +
                " pixels");
  }
  image.shade.resize(pixels);
  const auto byte = [&](std::size_t i) {
    return static_cast<unsigned>(static_cast<unsigned char>(raster[i]));
  };
  for (std::size_t i = 0; i < pixels; ++i) {
    const unsigned value = depth == 1 ? byte(i) : (byte(2 * i) << 8) + byte(2 * i + 1);
    image.shade[i] = static_cast<std::uint16_t>(std::min(value, static_cast<unsigned>(image.white)));
  }
}

}  // namespace

GreyImage decode_pgm(std::string_view bytes, const std::string& file) {
  PgmReader reader(bytes, file);
  const bool text = bytes.substr(0, 2) == "P2";
  if (!text && bytes.substr(0, 2) != "P5")
    reader.fail("is no PGM picture, expected one that starts with P2 or P5");
  GreyImage image;
  image.width = reader.next("width", 1, 1'000'000);
  image.height = reader.next("height", 1, 1'000'000);
  image.white = reader.next("largest shade", 1, 65535);
  if (image.pixels() > kMaxPixels) reader.fail("has too many pixels, expected at most 25 million");
  if (!text) {
    read_raster(reader.raster(), reader, image);
    return image;
  }
  // Memory only for what can be there: a digit and a blank a pixel.
  if (reader.raster().size() + 1 < 2 * image.pixels() - 1)
    reader.fail("is too short for its width and height");
  image.shade.reserve(image.pixels());
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    image.shade.push_back(static_cast<std::uint16_t>(reader.next("shade", 0, image.white)));
  }
  return image;
}

GreyImage decode_image(std::string_view bytes, const std::string& file) {
  if (bytes.substr(0, 4) == "\x89PNG") return decode_png(bytes, file);
  if (bytes.substr(0, 2) == "P2" || bytes.substr(0, 2) == "P5") return decode_pgm(bytes, file);
  throw complaint(file, 0, "is no picture this program reads, expected PGM (P2 or P5) or PNG");
}

}  // namespace seine::io
