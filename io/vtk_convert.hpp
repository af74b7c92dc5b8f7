// SPDX-License-Identifier: MIT
// Our pieces as VTK data sets. Included only where VTK is there, and never next to Kokkos.
#pragma once

#include "io/vtk_pieces.hpp"

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace arenite {

vtkSmartPointer<vtkPolyData> to_vtk(PolyPiece const& piece);
vtkSmartPointer<vtkImageData> to_vtk(ImagePiece const& piece);

/// The lines of a data set with its point data; arrays that are not of real numbers are left out.
PolyPiece lines_from_vtk(vtkPolyData& data, double time);

} // namespace arenite
