// SPDX-License-Identifier: MIT
// A ParaView collection: one .pvd file that gives each piece of a series its time. The file is replaced
// as a whole after each piece, so that it never names a piece that is not there.
#pragma once

#include "io/time_series.hpp"

namespace arenite {

class PvdSeries {
public:
    /// Series `name` in `folder`: name.pvd and name/name_000000.extension. Entries of an earlier run are
    /// dropped, and their pieces deleted, if they are later than the resume time (all without one).
    PvdSeries(std::filesystem::path folder, std::string name, std::string extension,
              std::optional<ResumePoint> const& resume = {});

    /// Where the next piece is to be written.
    std::filesystem::path next_piece() const;

    /// Lists the piece that was written there. A second state of the same time replaces the first.
    void add(Real time);

private:
    struct Entry {
        Real time = 0;
        int index = 0;
    };

    std::string piece_name(int index) const;
    std::vector<Entry> listed_entries() const;
    std::vector<Entry> drop_after(std::optional<ResumePoint> const& resume); // returns the dropped ones
    void delete_piece(Entry const& entry) const;
    void write_list() const;

    std::filesystem::path folder_;
    std::string name_, extension_;
    std::vector<Entry> entries_;
    int next_ = 0;
};

} // namespace arenite
