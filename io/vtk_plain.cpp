// SPDX-License-Identifier: MIT
// The VTK XML file format, version 1.0, with appended raw data: every array is a 64-bit byte count and
// the values as they lie in memory.
#include "io/vtk_pieces.hpp"

#include <fmt/format.h>

#include <bit>

namespace arenite {
namespace {

template <class T> constexpr char const* type_name = nullptr;
template <> constexpr char const* type_name<double> = "Float64";
template <> constexpr char const* type_name<int> = "Int32";
template <> constexpr char const* type_name<std::int64_t> = "Int64";

std::string escaped(std::string const& text)
{
    std::string result;
    for (char const c : text) {
        if (c == '&') result += "&amp;";
        else if (c == '<') result += "&lt;";
        else if (c == '"') result += "&quot;";
        else result += c;
    }
    return result;
}

/// The XML so far, and the data that it refers to.
class Document {
public:
    void text(std::string const& line) { xml_ += line + '\n'; }

    template <class T> void array(std::string const& name, int components, std::vector<T> const& values)
    {
        text(fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>",
                         type_name<T>, escaped(name), components, data_.size()));
        append(values);
    }

    void arrays(std::string const& section, std::vector<DataArray> const& list)
    {
        text("<" + section + ">");
        for (DataArray const& entry : list)
            std::visit([&](auto const& values) { array(entry.name, entry.components, values); }, entry.values);
        text("</" + section + ">");
    }

    void time(double value)
    {
        text("<FieldData>");
        text(fmt::format(
            "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"appended\" offset=\"{}\"/>",
            data_.size()));
        append(std::vector<double>{value});
        text("</FieldData>");
    }

    std::string file(char const* type) const
    {
        char const* const order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
        return fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}\" "
                           "header_type=\"UInt64\">\n"
                           "{}<AppendedData encoding=\"raw\">\n_",
                           type, order, xml_) +
               data_ + "\n</AppendedData>\n</VTKFile>\n";
    }

private:
    template <class T> void append(std::vector<T> const& values)
    {
        std::uint64_t const bytes = values.size() * sizeof(T);
        data_.append(reinterpret_cast<char const*>(&bytes), sizeof bytes);
        data_.append(reinterpret_cast<char const*>(values.data()), bytes);
    }

    std::string xml_, data_;
};

void write_cells(Document& document, char const* section, PolyPiece const& piece, bool used)
{
    static std::vector<std::int64_t> const none;
    document.text(fmt::format("<{}>", section));
    document.array("connectivity", 1, used ? piece.connectivity : none);
    document.array("offsets", 1, used ? piece.offsets : none);
    document.text(fmt::format("</{}>", section));
}

} // namespace

std::string encode_plain(PolyPiece const& piece)
{
    auto const cells = [&](CellKind kind) { return piece.kind == kind ? piece.offsets.size() : 0; };
    Document document;
    document.text("<PolyData>");
    document.time(piece.time);
    document.text(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" "
                              "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">",
                              piece.point_count(), cells(CellKind::vertices), cells(CellKind::lines),
                              cells(CellKind::polygons)));
    document.arrays("PointData", piece.point_data);
    document.arrays("CellData", piece.cell_data);
    document.text("<Points>");
    document.array("Points", 3, piece.points);
    document.text("</Points>");
    write_cells(document, "Verts", piece, piece.kind == CellKind::vertices);
    write_cells(document, "Lines", piece, piece.kind == CellKind::lines);
    write_cells(document, "Strips", piece, false);
    write_cells(document, "Polys", piece, piece.kind == CellKind::polygons);
    document.text("</Piece>\n</PolyData>");
    return document.file("PolyData");
}

std::string encode_plain(ImagePiece const& piece)
{
    std::string const extent = fmt::format("0 {} 0 {} 0 {}", piece.cells[0], piece.cells[1], piece.cells[2]);
    Document document;
    document.text(fmt::format("<ImageData WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\">", extent,
                              piece.lower[0], piece.lower[1], piece.lower[2], piece.spacing[0], piece.spacing[1],
                              piece.spacing[2]));
    document.time(piece.time);
    document.text(fmt::format("<Piece Extent=\"{}\">\n<PointData>\n</PointData>", extent));
    document.arrays("CellData", piece.cell_data);
    document.text("</Piece>\n</ImageData>");
    return document.file("ImageData");
}

} // namespace arenite
