#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>

#include "seine/io/image.hpp"
#include "seine/io/message.hpp"

namespace seine::io {
namespace {

// libpng reports errors by longjmp, over which no object with a destructor may live: everything with one
// stands in these structs, made before setjmp and destroyed after it.
struct Decoding {
  std::string_view bytes;
  std::size_t at = 0;
  char error[120] = "";
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::uint32_t width = 0, height = 0;
  std::size_t channels = 0;
  std::vector<png_byte> pixels;
  std::vector<png_bytep> rows;

  ~Decoding() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct Encoding {
  std::string bytes;
  std::vector<png_byte> row;
  png_structp png = nullptr;
  png_infop info = nullptr;

  ~Encoding() { png_destroy_write_struct(&png, &info); }
};

void on_error(png_structp png, png_const_charp message) {
  auto* decoding = static_cast<Decoding*>(png_get_error_ptr(png));
  if (decoding != nullptr) std::strncpy(decoding->error, message, sizeof decoding->error - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void take_bytes(png_structp png, png_bytep out, std::size_t count) {
  auto& decoding = *static_cast<Decoding*>(png_get_io_ptr(png));
  if (decoding.bytes.size() - decoding.at < count) png_error(png, "it ends too early");
  std::memcpy(out, decoding.bytes.data() + decoding.at, count);
  decoding.at += count;
}

void give_bytes(png_structp png, png_bytep data, std::size_t count) {
  static_cast<Encoding*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(data), count);
}

/// Reads everything up to the pixels and asks for 8 bits a channel, palette and transparency expanded. False
/// after an error.
bool begin_decoding(Decoding& d) {
  if (setjmp(png_jmpbuf(d.png)) != 0) return false;
  png_set_read_fn(d.png, &d, take_bytes);
  png_set_user_limits(d.png, 1'000'000, 1'000'000);
  png_set_chunk_cache_max(d.png, 16);
  png_set_chunk_malloc_max(d.png, 1 << 20);
  png_read_info(d.png, d.info);
  d.width = png_get_image_width(d.png, d.info);
  d.height = png_get_image_height(d.png, d.info);
  if (static_cast<std::size_t>(d.width) * d.height > kMaxPixels)
    png_error(d.png, "it has over 25 million pixels");
  // Deflate packs at most 1032 bytes into one: a small file that claims more is refused before memory is
  // taken for it.
  if (png_get_rowbytes(d.png, d.info) * d.height / 1040 > d.bytes.size())
    png_error(d.png, "it is too short for its size");
  png_set_expand(d.png);
  png_set_scale_16(d.png);
  png_set_interlace_handling(d.png);
  png_read_update_info(d.png, d.info);
  d.channels = png_get_channels(d.png, d.info);
  return true;
}

bool finish_decoding(Decoding& d) {
  if (setjmp(png_jmpbuf(d.png)) != 0) return false;
  png_read_image(d.png, d.rows.data());
  return true;
}

GreyImage averaged(const Decoding& d) {
  const std::size_t colours = d.channels >= 3 ? 3 : 1;
  const bool alpha = d.channels == 2 || d.channels == 4;
  GreyImage image{
      static_cast<int>(d.width), static_cast<int>(d.height), static_cast<int>(255 * colours), {}, {}};
  const std::size_t pixels = image.pixels();
  image.shade.resize(pixels);
  if (alpha) image.transparent.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const png_byte* pixel = d.pixels.data() + i * d.channels;
    unsigned sum = 0;
    for (std::size_t c = 0; c < colours; ++c) sum += pixel[c];
    image.shade[i] = static_cast<std::uint16_t>(sum);
    if (alpha) image.transparent[i] = pixel[colours] < 128 ? 1 : 0;
  }
  return image;
}

bool encode(Encoding& e, int width, int height, const std::vector<std::uint8_t>& mask, std::uint32_t colour) {
  if (setjmp(png_jmpbuf(e.png)) != 0) return false;
  png_set_write_fn(e.png, &e, give_bytes, nullptr);
  png_set_IHDR(e.png, e.info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 1,
               PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  const png_color palette[2] = {
      {255, 255, 255},
      {static_cast<png_byte>(colour >> 16), static_cast<png_byte>(colour >> 8 & 255U),
       static_cast<png_byte>(colour & 255U)}};
  const png_byte opacity[2] = {0, 255};
  png_set_PLTE(e.png, e.info, palette, 2);
  png_set_tRNS(e.png, e.info, opacity, 2, nullptr);
  png_write_info(e.png, e.info);
  for (int row = 0; row < height; ++row) {
    std::fill(e.row.begin(), e.row.end(), png_byte{0});
    for (int column = 0; column < width; ++column) {
      const std::size_t i =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
      if (mask[i] != 0)
        e.row[static_cast<std::size_t>(column) / 8] |= static_cast<png_byte>(0x80 >> (column % 8));
    }
    png_write_row(e.png, e.row.data());
  }
  png_write_end(e.png, nullptr);
  return true;
}

}  // namespace

GreyImage decode_png(std::string_view bytes, const std::string& file) {
  Decoding decoding{.bytes = bytes, .pixels = {}, .rows = {}};
  decoding.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &decoding, on_error, on_warning);
  if (decoding.png != nullptr) decoding.info = png_create_info_struct(decoding.png);
  if (decoding.info == nullptr) throw Error("libpng does not start");
  bool good = begin_decoding(decoding);
  if (good) {
    const std::size_t row_bytes = png_get_rowbytes(decoding.png, decoding.info);
    decoding.pixels.resize(row_bytes * decoding.height);
    for (std::size_t row = 0; row < decoding.height; ++row)
      decoding.rows.push_back(&decoding.pixels[row * row_bytes]);
    good = finish_decoding(decoding);
  }
  if (!good) throw complaint(file, 0, std::string("is no sound PNG picture: ") + decoding.error);
  return averaged(decoding);
}

std::string encode_mask_png(int width, int height, const std::vector<std::uint8_t>& mask,
                            std::uint32_t colour) {
  Encoding encoding;
  encoding.row.resize((static_cast<std::size_t>(width) + 7) / 8);
  encoding.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning);
  if (encoding.png != nullptr) encoding.info = png_create_info_struct(encoding.png);
  if (encoding.info == nullptr || !encode(encoding, width, height, mask, colour))
    throw Error("libpng cannot write");
  return std::move(encoding.bytes);
}

}  // namespace seine::io
