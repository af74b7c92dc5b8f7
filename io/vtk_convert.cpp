// SPDX-License-Identifier: MIT
#include "io/vtk_convert.hpp"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>

namespace arenite {
namespace {

template <class ArrayType, class T>
vtkSmartPointer<ArrayType> filled(std::string const& name, int components, std::vector<T> const& values)
{
    auto array = vtkSmartPointer<ArrayType>::New();
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
    std::copy(values.begin(), values.end(), array->GetPointer(0));
    return array;
}

struct ToVtkArray {
    DataArray const& entry;
    vtkSmartPointer<vtkDataArray> operator()(std::vector<double> const& v) const
    {
        return filled<vtkDoubleArray>(entry.name, entry.components, v);
    }
    vtkSmartPointer<vtkDataArray> operator()(std::vector<int> const& v) const
    {
        return filled<vtkIntArray>(entry.name, entry.components, v);
    }
    vtkSmartPointer<vtkDataArray> operator()(std::vector<std::int64_t> const& v) const
    {
        return filled<vtkTypeInt64Array>(entry.name, entry.components, v);
    }
};

void add_arrays(vtkFieldData& target, std::vector<DataArray> const& arrays)
{
    for (DataArray const& entry : arrays) target.AddArray(std::visit(ToVtkArray{entry}, entry.values));
}

void add_time(vtkDataSet& data, double time)
{
    data.GetFieldData()->AddArray(filled<vtkDoubleArray>("TimeValue", 1, std::vector<double>{time}));
}

vtkSmartPointer<vtkCellArray> cells_of(PolyPiece const& piece)
{
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    std::int64_t begin = 0;
    for (std::int64_t const end : piece.offsets) {
        cells->InsertNextCell(static_cast<vtkIdType>(end - begin));
        for (std::int64_t i = begin; i < end; ++i) cells->InsertCellPoint(static_cast<vtkIdType>(piece.connectivity[i]));
        begin = end;
    }
    return cells;
}

} // namespace

vtkSmartPointer<vtkPolyData> to_vtk(PolyPiece const& piece)
{
    auto data = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetData(filled<vtkDoubleArray>("Points", 3, piece.points));
    data->SetPoints(points);
    auto const cells = cells_of(piece);
    if (piece.kind == CellKind::vertices) data->SetVerts(cells);
    else if (piece.kind == CellKind::lines) data->SetLines(cells);
    else data->SetPolys(cells);
    add_arrays(*data->GetPointData(), piece.point_data);
    add_arrays(*data->GetCellData(), piece.cell_data);
    add_time(*data, piece.time);
    return data;
}

vtkSmartPointer<vtkImageData> to_vtk(ImagePiece const& piece)
{
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(piece.cells[0] + 1, piece.cells[1] + 1, piece.cells[2] + 1);
    image->SetOrigin(piece.lower[0], piece.lower[1], piece.lower[2]);
    image->SetSpacing(piece.spacing[0], piece.spacing[1], piece.spacing[2]);
    add_arrays(*image->GetCellData(), piece.cell_data);
    add_time(*image, piece.time);
    return image;
}

PolyPiece lines_from_vtk(vtkPolyData& data, double time)
{
    PolyPiece piece;
    piece.time = time;
    piece.kind = CellKind::lines;
    for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
        double const* const point = data.GetPoint(i);
        piece.points.insert(piece.points.end(), point, point + 3);
    }
    auto const cell = vtk::TakeSmartPointer(data.GetLines()->NewIterator());
    for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell()) {
        vtkIdType size = 0;
        vtkIdType const* ids = nullptr;
        cell->GetCurrentCell(size, ids);
        piece.connectivity.insert(piece.connectivity.end(), ids, ids + size);
        piece.offsets.push_back(static_cast<std::int64_t>(piece.connectivity.size()));
    }
    for (int a = 0; a < data.GetPointData()->GetNumberOfArrays(); ++a) {
        auto* const array = vtkDoubleArray::SafeDownCast(data.GetPointData()->GetArray(a));
        if (array == nullptr) continue;
        double const* const first = array->GetPointer(0);
        piece.point_data.push_back({array->GetName(), array->GetNumberOfComponents(),
                                    std::vector<double>(first, first + array->GetNumberOfValues())});
    }
    return piece;
}

} // namespace arenite
