// SPDX-License-Identifier: MIT
// Files by VTK's own XML writers: appended, raw, compressed by zlib, which every reader of the format
// knows. They are encoded in memory, so that all files are stored, and all faults told, in one way.
#include "io/vtk_convert.hpp"

#include "io/atomic_file.hpp"

#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>

namespace arenite {
namespace {

template <class Writer, class Data> std::string written_by_vtk(Data* data)
{
    vtkNew<Writer> writer;
    writer->SetInputData(data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToZLib();
    writer->SetCompressionLevel(1); // the higher levels cost time and save little on doubles
    writer->SetHeaderTypeToUInt64();
    writer->WriteToOutputStringOn();
    if (writer->Write() != 1) throw OutputError("VTK could not encode a field file; is the memory full?");
    return writer->GetOutputString();
}

} // namespace

std::string encode(PolyPiece const& piece) { return written_by_vtk<vtkXMLPolyDataWriter>(to_vtk(piece).Get()); }

std::string encode(ImagePiece const& piece) { return written_by_vtk<vtkXMLImageDataWriter>(to_vtk(piece).Get()); }

} // namespace arenite
