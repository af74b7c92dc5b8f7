// SPDX-License-Identifier: MIT
#include "io/pvd.hpp"

#include <fmt/format.h>

#include <charconv>
#include <regex>

namespace arenite {

PvdSeries::PvdSeries(std::filesystem::path folder, std::string name, std::string extension,
                     std::optional<ResumePoint> const& resume)
    : folder_(std::move(folder)), name_(std::move(name)), extension_(std::move(extension))
{
    make_folder(folder_ / name_);
    remove_unfinished(folder_ / name_);
    std::vector<Entry> const dropped = drop_after(resume);
    if (entries_.empty()) std::filesystem::remove(folder_ / (name_ + ".pvd"));
    else write_list();
    for (Entry const& entry : dropped) delete_piece(entry); // only now that no list names them
}

std::string PvdSeries::piece_name(int index) const { return fmt::format("{0}/{0}_{1:06}.{2}", name_, index, extension_); }

std::filesystem::path PvdSeries::next_piece() const { return folder_ / piece_name(next_); }

void PvdSeries::add(Real time)
{
    std::optional<Entry> replaced;
    if (!entries_.empty() && entries_.back().time == time) {
        replaced = entries_.back();
        entries_.pop_back();
    }
    entries_.push_back({time, next_++});
    write_list();
    if (replaced) delete_piece(*replaced);
}

/// Reads our own list back; only names of the form that this series writes count, since what is dropped
/// gets deleted.
std::vector<PvdSeries::Entry> PvdSeries::listed_entries() const
{
    auto const path = folder_ / (name_ + ".pvd");
    if (!std::filesystem::exists(path)) return {};
    std::string const content = read_file(path);
    std::regex const line("<DataSet timestep=\"([^\"]+)\" file=\"" + name_ + "/" + name_ + "_([0-9]{6,9})\\." + extension_ +
                          "\"/>");
    std::vector<Entry> entries;
    for (std::sregex_iterator match(content.begin(), content.end(), line), end; match != end; ++match) {
        std::string const time = (*match)[1].str();
        Entry entry{0, std::stoi((*match)[2].str())};
        auto const [stop, error] = std::from_chars(time.data(), time.data() + time.size(), entry.time);
        if (error == std::errc() && stop == time.data() + time.size()) entries.push_back(entry);
    }
    return entries;
}

std::vector<PvdSeries::Entry> PvdSeries::drop_after(std::optional<ResumePoint> const& resume)
{
    std::vector<Entry> dropped;
    for (Entry const& entry : listed_entries()) {
        if (resume && entry.time <= resume->time) {
            entries_.push_back(entry);
            next_ = entry.index + 1;
        } else {
            dropped.push_back(entry);
        }
    }
    return dropped;
}

void PvdSeries::delete_piece(Entry const& entry) const
{
    std::error_code ignored; // a piece that stays is not listed any more and does no harm
    std::filesystem::remove(folder_ / piece_name(entry.index), ignored);
}

void PvdSeries::write_list() const
{
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
                       "byte_order=\"LittleEndian\">\n  <Collection>\n";
    for (Entry const& entry : entries_)
        text += fmt::format("    <DataSet timestep=\"{}\" file=\"{}\"/>\n", entry.time, piece_name(entry.index));
    write_file_atomically(folder_ / (name_ + ".pvd"), text + "  </Collection>\n</VTKFile>\n");
}

} // namespace arenite
