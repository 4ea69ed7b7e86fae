#include "base/digest.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"

namespace scotopic {
namespace {

/// FIPS 180-4's examples, as NIST publishes them with intermediate values.
const struct Example {
  std::string bytes;
  const char* digest;
} examples[] = {
    {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
    {"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
    {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
     "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
    {std::string(1000000, 'a'), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"},
};

TEST(Sha256, published_examples) {
  for (const Example& e : examples) EXPECT_EQ(sha256(e.bytes), e.digest) << e.bytes.size() << " bytes";
}

TEST(Sha256, a_file_has_the_digest_of_its_bytes_however_many_blocks_they_fill) {
  const std::string file = std::filesystem::temp_directory_path() / "scotopic_digest_test";
  for (const std::size_t size : {0u, 1u, 1u << 20, (1u << 20) + 1, 3u << 20}) {
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * 131 >> 3);
    std::ofstream(file, std::ios::binary) << bytes;
    EXPECT_EQ(sha256_of_file(file), sha256(bytes)) << size;
  }
  std::filesystem::remove(file);
}

TEST(Sha256, no_file_a_folder_and_a_device_are_refused) {
  for (const char* place : {"/no/such/file", "/tmp", "/dev/zero"}) try {
      (void)sha256_of_file(place);
      ADD_FAILURE() << place;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input) << place;
      EXPECT_EQ(error.file(), place);
    }
}

}  // namespace
}  // namespace scotopic
