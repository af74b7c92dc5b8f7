// SPDX-License-Identifier: MIT
#include "io/progress.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <unistd.h>

namespace arenite {
namespace {

double seconds_now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

} // namespace

std::string duration_text(double seconds)
{
    if (!std::isfinite(seconds) || seconds > 1e12) return "unknown";
    auto const s = static_cast<long long>(std::llround(seconds));
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
    if (s < 86400) return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
    return fmt::format("{} d {} h", s / 86400, s / 3600 % 24);
}

Progress::Progress() : Progress(std::cerr, ::isatty(STDERR_FILENO) == 1, seconds_now) {}

Progress::Progress(std::ostream& stream, bool shown, Clock clock)
    : stream_(stream), shown_(shown), clock_(std::move(clock)), begin_(clock_())
{
}

Progress::~Progress()
{
    if (width_ > 0) stream_ << '\n' << std::flush;
}

void Progress::start_stage(ProgressState const& state, double now)
{
    stage_ = state.stage;
    stage_begin_ = now;
    stage_begin_time_ = state.time;
    rate_ = 0;
    last_ = now;
    last_state_ = state;
}

void Progress::update(ProgressState const& state)
{
    if (!shown_) return;
    double const now = clock_();
    if (state.stage != stage_) start_stage(state, now);
    if (now - last_ < 1) return;
    rate_ = static_cast<double>(state.step - last_state_.step) * static_cast<double>(state.grains) / (now - last_);
    last_ = now;
    last_state_ = state;
    std::string const text = line(state, now);
    stream_ << '\r' << text << std::string(width_ > text.size() ? width_ - text.size() : 0, ' ') << std::flush;
    width_ = text.size();
}

void Progress::clear()
{
    if (width_ > 0) stream_ << '\r' << std::string(width_, ' ') << '\r' << std::flush;
    width_ = 0;
}

std::string Progress::line(ProgressState const& state, double now) const
{
    std::string text = fmt::format("{}: {:.4g} s", state.stage, state.time);
    if (state.end_time > 0)
        text += fmt::format(" of {:.4g} s ({:.0f} %)", state.end_time, 100 * state.time / state.end_time);
    text += fmt::format(", wall {}, {:.2e} particle-steps/s", duration_text(now - begin_), rate_);
    Real const done = state.time - stage_begin_time_;
    if (state.end_time > 0 && done > 0)
        text += fmt::format(", {} left", duration_text((now - stage_begin_) * (state.end_time - state.time) / done));
    return text;
}

} // namespace arenite
