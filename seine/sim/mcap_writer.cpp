#include "seine/sim/mcap_writer.hpp"

#include <cassert>

namespace seine::sim {
namespace {

constexpr std::size_t kChunkSize = 1 << 20;  // bytes
constexpr std::string_view kMagic = "\x89MCAP0\r\n";

enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

// Numbers are little-endian, texts and lists begin with their length in bytes.
class Bytes {
 public:
  template <class Unsigned>
  Bytes& number(Unsigned value) {
    for (std::size_t i = 0; i < sizeof value; ++i) text_ += static_cast<char>((value >> (8 * i)) & 0xFF);
    return *this;
  }
  Bytes& text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    return raw(text);
  }
  Bytes& raw(std::string_view text) {
    text_ += text;
    return *this;
  }
  const std::string& str() const { return text_; }

 private:
  std::string text_;
};

std::string record(Opcode opcode, const Bytes& content) {
  return Bytes()
      .number<std::uint8_t>(opcode)
      .number<std::uint64_t>(content.str().size())
      .raw(content.str())
      .str();
}

std::string map_of(const std::map<std::uint16_t, std::uint64_t>& map) {
  Bytes bytes;
  for (const auto& [key, value] : map) bytes.number(key).number(value);
  return bytes.str();
}

}  // namespace

McapWriter::McapWriter(std::ostream& out) : out_(out) {
  put(std::string(kMagic));
  put(record(kHeader, Bytes().text("").text("seine")));
}

void McapWriter::put(const std::string& bytes) {
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  position_ += bytes.size();
}

std::uint16_t McapWriter::add_schema(std::string_view name, std::string_view json_schema) {
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);  // 0 means none
  schemas_.push_back(record(kSchema, Bytes().number(id).text(name).text("jsonschema").text(json_schema)));
  chunk_ += schemas_.back();
  return id;
}

std::uint16_t McapWriter::add_channel(std::string_view topic, std::uint16_t schema) {
  const auto id = static_cast<std::uint16_t>(channels_.size());
  channels_.push_back(record(kChannel, Bytes().number(id).number(schema).text(topic).text("json").text("")));
  chunk_ += channels_.back();
  return id;
}

void McapWriter::write(std::uint16_t channel, std::uint64_t time, std::string_view json) {
  assert(channel < channels_.size() && time >= last_);
  if (messages_ == 0) first_ = time;
  if (entries_.empty()) chunk_first_ = time;
  last_ = time;
  const auto sequence = static_cast<std::uint32_t>(counts_[channel]++);
  entries_[channel].push_back({time, chunk_.size()});
  chunk_ += record(kMessage, Bytes().number(channel).number(sequence).number(time).number(time).raw(json));
  ++messages_;
  if (chunk_.size() >= kChunkSize) flush_chunk();
}

void McapWriter::flush_chunk() {
  if (chunk_.empty()) return;
  if (entries_.empty()) chunk_first_ = last_;
  ChunkPlace place{.first = chunk_first_, .last = last_, .start = position_, .size = chunk_.size()};
  put(record(kChunk, Bytes()
                         .number(place.first)
                         .number(place.last)
                         .number<std::uint64_t>(chunk_.size())
                         .number<std::uint32_t>(0)
                         .text("")
                         .number<std::uint64_t>(chunk_.size())
                         .raw(chunk_)));
  place.length = position_ - place.start;
  for (const auto& [channel, entries] : entries_) {
    place.indexes[channel] = position_;
    Bytes list;
    for (const Entry& entry : entries) list.number(entry.time).number(entry.offset);
    put(record(kMessageIndex, Bytes().number(channel).text(list.str())));
  }
  place.indexes_length = position_ - place.start - place.length;
  chunks_.push_back(place);
  chunk_.clear();
  entries_.clear();
}

void McapWriter::close() {
  flush_chunk();
  put(record(kDataEnd, Bytes().number<std::uint32_t>(0)));
  put_summary();
  put(std::string(kMagic));
  out_.flush();
}

// Returns where the group begins and notes it among the offsets.
std::uint64_t McapWriter::put_group(std::uint8_t opcode, const std::vector<std::string>& records,
                                    std::string& offsets) {
  const std::uint64_t start = position_;
  for (const std::string& one : records) put(one);
  if (!records.empty())
    offsets += record(kSummaryOffset, Bytes().number(opcode).number(start).number(position_ - start));
  return start;
}

void McapWriter::put_summary() {
  std::string offsets;
  const std::uint64_t start = put_group(kSchema, schemas_, offsets);
  put_group(kChannel, channels_, offsets);
  put_group(kStatistics,
            {record(kStatistics, Bytes()
                                     .number(messages_)
                                     .number(static_cast<std::uint16_t>(schemas_.size()))
                                     .number(static_cast<std::uint32_t>(channels_.size()))
                                     .number<std::uint32_t>(0)
                                     .number<std::uint32_t>(0)
                                     .number(static_cast<std::uint32_t>(chunks_.size()))
                                     .number(first_)
                                     .number(last_)
                                     .text(map_of(counts_)))},
            offsets);
  std::vector<std::string> indexes;
  for (const ChunkPlace& chunk : chunks_) {
    indexes.push_back(record(kChunkIndex, Bytes()
                                              .number(chunk.first)
                                              .number(chunk.last)
                                              .number(chunk.start)
                                              .number(chunk.length)
                                              .text(map_of(chunk.indexes))
                                              .number(chunk.indexes_length)
                                              .text("")
                                              .number(chunk.size)
                                              .number(chunk.size)));
  }
  put_group(kChunkIndex, indexes, offsets);
  const std::uint64_t offsets_start = position_;
  put(offsets);
  put(record(kFooter, Bytes().number(start).number(offsets_start).number<std::uint32_t>(0)));
}

}  // namespace seine::sim
