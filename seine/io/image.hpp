#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace seine::io {

/// A grey picture. Row 0 is the top.
struct GreyImage {
  int width = 0;
  int height = 0;
  int white = 255;                        ///< the shade of white; 0 is black
  std::vector<std::uint16_t> shade;       ///< width × height, row-major
  std::vector<std::uint8_t> transparent;  ///< empty, or 1 where the picture has no colour; width × height

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// Pictures with more pixels are refused.
inline constexpr std::size_t kMaxPixels = 25'000'000;

/// PGM, binary (P5) or text (P2), up to 16 bits, or PNG of any colour type (colours are averaged, without
/// gamma); told apart by their first bytes. Throws InputError.
/// @param file name for messages
GreyImage decode_image(std::string_view bytes, const std::string& file);

/// Behind decode_image.
GreyImage decode_pgm(std::string_view bytes, const std::string& file);
GreyImage decode_png(std::string_view bytes, const std::string& file);

/// A PNG with one bit a pixel, row 0 at the top: 0 is transparent, 1 has the colour 0xRRGGBB.
std::string encode_mask_png(int width, int height, const std::vector<std::uint8_t>& mask,
                            std::uint32_t colour);

}  // namespace seine::io
