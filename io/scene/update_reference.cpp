// SPDX-License-Identifier: MIT
// Puts the table of keys into docs/scene.md after its marker; what stands before it is written by hand.
#include "io/scene_reader.hpp"

#include <fstream>
#include <iostream>
#include <iterator>

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::cerr << "usage: arenite_scene_reference docs/scene.md\n";
        return 2;
    }
    std::ifstream in(argv[1], std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    std::size_t const marker = text.find(arenite::scene_reference_marker);
    if (marker == std::string::npos) {
        std::cerr << argv[1] << ": has no line " << arenite::scene_reference_marker << "\n";
        return 1;
    }
    text = text.substr(0, marker) + arenite::scene_reference_marker + "\n\n" + arenite::scene_reference();
    std::ofstream(argv[1], std::ios::binary) << text;
}
