// SPDX-License-Identifier: MIT
#include "core/error.hpp"
#include "io/stl.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace arenite {
namespace {

std::string const ascii = "solid wedge of sand\n"
                          "facet normal 0 0 1\n outer loop\n"
                          "  vertex 0 0 0\n  vertex 1 0 0\n  vertex +0 1e0 -0.5\n endloop\nendfacet\n"
                          "FACET NORMAL nan nan nan\r\n OUTER LOOP\r\n"
                          "  VERTEX 1 0 0\r\n  VERTEX 1 1 0\r\n  VERTEX 0 1 0\r\n ENDLOOP\r\nENDFACET\r\n"
                          "endsolid wedge of sand\n";

std::string binary(int announced, std::vector<Triangle> const& triangles, std::string header = "made by a test")
{
    header.resize(80);
    std::string bytes = header;
    auto const append = [&](auto value) {
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        bytes.append(raw, sizeof value);
    };
    append(std::uint32_t(announced));
    for (Triangle const& t : triangles) {
        for (int n = 0; n < 3; ++n) append(0.f);
        for (Vec3 const& corner : t.corner)
            for (int axis = 0; axis < 3; ++axis) append(static_cast<float>(corner[axis]));
        append(std::uint16_t(0));
    }
    return bytes;
}

TEST(Stl, ReadsAscii)
{
    std::vector<Triangle> const triangles = parse_stl(ascii, "wedge.stl");
    ASSERT_EQ(triangles.size(), 2u);
    EXPECT_EQ(triangles[0].corner[2], (Vec3{0, 1, -0.5}));
    EXPECT_EQ(triangles[1].corner[1], (Vec3{1, 1, 0}));
}

TEST(Stl, ReadsBinaryEvenIfItsHeaderSaysSolid)
{
    std::vector<Triangle> const expected = parse_stl(ascii, "wedge.stl");
    for (std::string const header : {"plain", "solid work of some program"}) {
        std::vector<Triangle> const found = parse_stl(binary(2, expected, header), "wedge.stl");
        ASSERT_EQ(found.size(), 2u);
        for (int t = 0; t < 2; ++t)
            for (int k = 0; k < 3; ++k) EXPECT_EQ(found[t].corner[k], expected[t].corner[k]);
    }
}

TEST(Stl, RefusesEveryTruncation)
{
    std::string const whole = binary(2, parse_stl(ascii, "wedge.stl"));
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_THROW(parse_stl(whole.substr(0, size), "cut"), InputError);
    std::size_t const last = ascii.rfind("endsolid") + 8;
    for (std::size_t size = 0; size < last; ++size) EXPECT_THROW(parse_stl(ascii.substr(0, size), "cut"), InputError);
}

TEST(Stl, RefusesGarbageWithoutAskingForItsMemory)
{
    EXPECT_THROW(parse_stl(binary(-1, {}), "huge"), InputError);
    EXPECT_THROW(parse_stl(binary(0, {}), "none"), InputError);
    EXPECT_THROW(parse_stl("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n", "word"), InputError);
    EXPECT_THROW(parse_stl("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1e999\n", "large"), InputError);
    EXPECT_THROW(read_stl("no/such/file.stl"), InputError);
    std::vector<Triangle> bad = parse_stl(ascii, "wedge.stl");
    bad[1].corner[0].y = std::numeric_limits<Real>::quiet_NaN();
    EXPECT_THROW(parse_stl(binary(2, bad), "nan"), InputError);
    std::mt19937 random(5);
    for (int n = 0; n < 2000; ++n) { // random bytes, and a good file with some bytes changed: no crash, no hang
        std::string bytes = n % 2 ? ascii : binary(2, parse_stl(ascii, "w"));
        for (int k = 0; k < 1 + n % 7; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
        try {
            parse_stl(bytes, "changed");
        } catch (InputError const&) {
        }
    }
}

TEST(Stl, NamesTheLine)
{
    try {
        parse_stl("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n", "a.stl");
        FAIL();
    } catch (InputError const& error) {
        EXPECT_STREQ(error.what(), "a.stl:4: ASCII STL: a number expected, found 'zero'");
    }
}

} // namespace
} // namespace arenite
