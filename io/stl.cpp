// SPDX-License-Identifier: MIT
#include "io/stl.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string_view>

namespace arenite {
namespace {

constexpr std::size_t header_size = 84, record_size = 50; // 80 bytes of text and a count; 12 floats and 2 bytes

std::uint32_t little_endian_word(std::string const& bytes, std::size_t at)
{
    std::uint32_t word = 0;
    for (int b = 3; b >= 0; --b) word = (word << 8) | static_cast<unsigned char>(bytes[at + b]);
    return word;
}

std::vector<Triangle> parse_binary(std::string const& bytes, std::string const& name)
{
    std::uint64_t const count = little_endian_word(bytes, 80);
    std::uint64_t const held = (bytes.size() - header_size) / record_size;
    if (count > held) // also keeps a wrong count from asking for memory
        throw InputError(
            fmt::format("{}: binary STL: {} triangles are announced, the file ends after {}", name, count, held));
    std::vector<Triangle> triangles(count);
    for (std::size_t t = 0; t < count; ++t)
        for (int k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis) {
                std::size_t const at = header_size + t * record_size + 12 + 4 * (3 * k + axis);
                float const value = std::bit_cast<float>(little_endian_word(bytes, at));
                if (!std::isfinite(value))
                    throw InputError(fmt::format("{}: binary STL: triangle {}: a coordinate is not a number", name, t + 1));
                triangles[t].corner[k][axis] = value;
            }
    return triangles;
}

/// Words of a text, with the line that they stand in.
class Words {
public:
    Words(std::string_view text, std::string const& name) : text_(text), name_(name) {}

    std::string_view next()
    {
        while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n';
        std::size_t const begin = at_;
        while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
        return text_.substr(begin, at_ - begin);
    }
    void skip_line()
    {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    }
    void expect(std::string_view word)
    {
        std::string_view const found = next();
        if (!same(found, word)) fail(fmt::format("'{}' expected, found '{}'", word, shown(found)));
    }
    Real number()
    {
        std::string_view word = next();
        std::string_view digits = word;
        if (!digits.empty() && digits[0] == '+') digits.remove_prefix(1);
        Real value = 0;
        auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
            fail(fmt::format("a number expected, found '{}'", shown(word)));
        return value;
    }
    [[noreturn]] void fail(std::string const& what) const
    {
        throw InputError(fmt::format("{}:{}: ASCII STL: {}", name_, line_, what));
    }
    static bool same(std::string_view a, std::string_view b) // letters of either case
    {
        if (a.size() != b.size()) return false;
        for (std::size_t n = 0; n < a.size(); ++n)
            if ((a[n] | 0x20) != (b[n] | 0x20)) return false;
        return true;
    }
    static std::string shown(std::string_view word)
    {
        if (word.empty()) return "the end of the file";
        std::string text;
        for (char c : word.substr(0, 24)) text += c >= ' ' && c <= '~' ? c : '?';
        return text;
    }

private:
    static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    std::string_view text_;
    std::string const& name_;
    std::size_t at_ = 0;
    int line_ = 1;
};

Triangle parse_facet(Words& words)
{
    words.expect("normal");
    for (int axis = 0; axis < 3; ++axis) words.next(); // not used; some programs write "nan" here
    words.expect("outer");
    words.expect("loop");
    Triangle triangle;
    for (Vec3& corner : triangle.corner) {
        words.expect("vertex");
        for (int axis = 0; axis < 3; ++axis) corner[axis] = words.number();
    }
    words.expect("endloop");
    words.expect("endfacet");
    return triangle;
}

std::vector<Triangle> parse_ascii(std::string const& bytes, std::string const& name)
{
    Words words(bytes, name);
    std::vector<Triangle> triangles;
    words.expect("solid");
    words.skip_line(); // the solid's name
    bool open = true;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (open && Words::same(word, "facet")) triangles.push_back(parse_facet(words));
        else if (open && Words::same(word, "endsolid")) {
            words.skip_line();
            open = false;
        } else if (!open && Words::same(word, "solid")) {
            words.skip_line();
            open = true;
        } else words.fail(fmt::format("'facet' or 'endsolid' expected, found '{}'", Words::shown(word)));
    }
    if (open) words.fail("the file ends before 'endsolid'");
    return triangles;
}

bool starts_with_solid(std::string const& bytes)
{
    std::size_t const begin = bytes.find_first_not_of(" \t\r\n");
    return begin != std::string::npos && Words::same(std::string_view(bytes).substr(begin, 5), "solid");
}

} // namespace

std::vector<Triangle> parse_stl(std::string const& bytes, std::string const& name)
{
    // Binary headers may begin with "solid" too: there the announced count tells the file's size exactly.
    bool const sized = bytes.size() >= header_size &&
                       bytes.size() == header_size + record_size * std::uint64_t(little_endian_word(bytes, 80));
    std::vector<Triangle> triangles;
    if (!sized && starts_with_solid(bytes)) triangles = parse_ascii(bytes, name);
    else if (bytes.size() >= header_size) triangles = parse_binary(bytes, name);
    else throw InputError(fmt::format("{}: not an STL file: {} bytes, no 'solid' at the start", name, bytes.size()));
    if (triangles.empty()) throw InputError(name + ": the STL file holds no triangles");
    return triangles;
}

std::vector<Triangle> read_stl(std::string const& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file) throw InputError(path + ": cannot be opened");
    std::string const bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (file.bad()) throw InputError(path + ": cannot be read");
    return parse_stl(bytes, path);
}

} // namespace arenite
