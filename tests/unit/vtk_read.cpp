// SPDX-License-Identifier: MIT
#include "tests/unit/vtk_read.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>

namespace arenite::test {
namespace {

std::map<std::string, FoundArray> arrays_of(vtkFieldData& data)
{
    std::map<std::string, FoundArray> found;
    for (int a = 0; a < data.GetNumberOfArrays(); ++a) {
        vtkDataArray* const array = data.GetArray(a);
        FoundArray& entry = found[array->GetName()];
        entry.type = array->GetDataTypeAsString();
        entry.components = array->GetNumberOfComponents();
        for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
            for (int c = 0; c < entry.components; ++c) entry.values.push_back(array->GetComponent(i, c));
    }
    return found;
}

FoundFile found_in(vtkDataSet& data)
{
    FoundFile found;
    found.points = data.GetNumberOfPoints();
    found.cells = data.GetNumberOfCells();
    data.GetBounds(found.bounds.data());
    found.point_data = arrays_of(*data.GetPointData());
    found.cell_data = arrays_of(*data.GetCellData());
    found.field_data = arrays_of(*data.GetFieldData());
    return found;
}

template <class Reader> bool opened(Reader& reader, std::filesystem::path const& path)
{
    if (reader.CanReadFile(path.c_str()) != 1) return false;
    reader.SetFileName(path.c_str());
    reader.Update();
    return reader.GetErrorCode() == 0;
}

} // namespace

FoundFile read_poly(std::filesystem::path const& path)
{
    vtkNew<vtkXMLPolyDataReader> reader;
    bool const good = opened(*reader, path);
    if (!good) return {};
    vtkPolyData& data = *reader->GetOutput();
    FoundFile found = found_in(data);
    found.opened = good;
    found.verts = data.GetNumberOfVerts();
    found.lines = data.GetNumberOfLines();
    found.polys = data.GetNumberOfPolys();
    for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i)
        found.coordinates.insert(found.coordinates.end(), data.GetPoint(i), data.GetPoint(i) + 3);
    vtkNew<vtkIdList> ids;
    for (vtkIdType i = 0; i < found.lines; ++i) {
        data.GetCellPoints(i, ids);
        found.line_points.emplace_back(ids->begin(), ids->end());
    }
    return found;
}

FoundFile read_image(std::filesystem::path const& path)
{
    vtkNew<vtkXMLImageDataReader> reader;
    bool const good = opened(*reader, path);
    if (!good) return {};
    FoundFile found = found_in(*reader->GetOutput());
    found.opened = good;
    return found;
}

} // namespace arenite::test
