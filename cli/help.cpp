#include "help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "console.hpp"
#include "thermedge/presets.hpp"

namespace thermedge::cli {
namespace {

constexpr std::size_t kWidth = 100;
constexpr std::size_t kColumn = 30;  // where the meanings begin

// The words of `text` in lines of at most `width`.
std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string> lines(1);
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width) {
      lines.emplace_back();
    }
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
}

// A label and its meaning in two columns.
std::string entry(const std::string& label, std::string_view meaning) {
  std::string text = "  " + label;
  if (text.size() + 2 > kColumn) {
    text += "\n" + std::string(kColumn, ' ');
  } else {
    text.resize(kColumn, ' ');
  }
  bool is_first = true;
  for (const std::string& line : wrapped(meaning, kWidth - kColumn)) {
    text += (is_first ? "" : std::string(kColumn, ' ')) + line + "\n";
    is_first = false;
  }
  return text;
}

std::string paragraph(std::string_view text) {
  std::string lines;
  for (const std::string& line : wrapped(text, kWidth)) {
    lines += line + "\n";
  }
  return lines;
}

std::string presets() {
  std::string text = "\nPresets:\n";
  for (const auto& [preset, name] : kPresets) {
    text += entry(std::string(name), preset_meaning(preset));
  }
  return text;
}

}  // namespace

std::vector<Example> examples_of(const std::string& command) {
  static const std::map<std::string, std::vector<Example>, std::less<>> examples = {
      {"detect",
       {{"thermedge detect frame.png -o edges.png", "the mask of the edges of one frame"},
        {"thermedge detect recording/ --preset fast -o out --write overlay,json",
         "overlays and edges of every frame of a directory"}}},
      {"track",
       {{"thermedge track recording/ -o tracks.jsonl", "edges with identities, a line a frame"},
        {"thermedge track 'sim:desk?path=shake&frames=100' -o out --write overlay",
         "pictures of a simulated stream, a colour an identity"}}},
      {"trace",
       {{"thermedge trace map.png -o edges.json", "edges of one binary edge map"},
        {"thermedge trace maps/ -o out --write json,svg", "of every map of a directory"}}},
      {"scale",
       {{"thermedge scale frame.png -o view.png --gain 0.2", "an 8-bit picture of one frame"},
        {"thermedge scale recording/ -o views --stable", "of a recording, without flicker"}}},
      {"denoise",
       {{"thermedge denoise frame.png -o quiet.png", "one frame, by BM3D"},
        {"thermedge denoise recording/ -o quiet --method nlm --sigma 6",
         "a directory, by non-local means, with the noise given in counts"}}},
      {"stages",
       {{"thermedge stages frame.png -o stages.png", "all steps on one sheet"},
        {"thermedge stages frame.png -o steps --format svg --preset paper",
         "each step of preset paper as a vector picture"}}},
      {"compare",
       {{"thermedge compare frame.png -o compare.png", "all detectors on one sheet"},
        {"thermedge compare recording/ -o out --write canny,thermedge",
         "and two of the edge maps for every frame"}}},
      {"radiation",
       {{"thermedge radiation -o planck.png", "Planck's curves of the usual temperatures"},
        {"thermedge radiation -o planck.svg --kelvin 290,310,330", "of three bodies, as vectors"}}},
      {"snr",
       {{"thermedge snr clear.png noisy.png -o snr.png", "two frames side by side"},
        {"thermedge snr 'sim:desk?frames=1' 'sim:desk?frames=1&sigma=40' -o snr.png",
         "the same scene with two levels of noise"}}},
      {"bench",
       {{"thermedge bench recording/ --threads 2", "times of the stages on two cores"},
        {"thermedge bench 'sim:desk?frames=20' --preset fast --json",
         "of preset fast on a simulated scene, as JSON"}}},
      {"probe",
       {{"thermedge probe recording/ --toml robot.toml",
         "what a recording is like, and the options that suit it for detect --config"},
        {"thermedge probe frame.png --camera optris --json", "temperatures too, as JSON"}}},
      {"simulate",
       {{"thermedge simulate desk -o desk --frames 20", "20 frames with their true edges"},
        {"thermedge simulate corridor -o out --camera boson --seed 7 --set bad_pixels=0",
         "another camera and path, without dead pixels"}}},
      {"evaluate",
       {{"thermedge evaluate out/mask truth/", "edge maps against true ones of the same names"},
        {"thermedge evaluate edges.jsonl desk/truth.jsonl --json",
         "edges of detect -o - against simulated truth, as JSON"}}},
      {"completion",
       {{"source <(thermedge completion bash)", "completion in this shell"},
        {"thermedge completion fish > ~/.config/fish/completions/thermedge.fish",
         "completion in every fish"}}},
      {"man",
       {{"thermedge man detect | man -l -", "reads the page of detect"},
        {"thermedge man -o man1", "writes all pages into a directory"}}}};
  const auto found = examples.find(command);
  return found == examples.end() ? std::vector<Example>() : found->second;
}

std::string full_help(const OptionText& option) {
  std::string text = option.help;
  const bool names_choices = std::all_of(
      option.choices.begin(), option.choices.end(),
      [&](const std::string& choice) { return text.find(choice) != std::string::npos; });
  if (!names_choices) {
    text += fmt::format(": {}", fmt::join(option.choices, ", "));
  }
  if (!option.limits.empty()) {
    text += "; " + option.limits;
  }
  if (!option.usual.empty()) {
    text += "; default " + option.usual;
  }
  return text;
}

std::string names_and_argument(const OptionText& option) {
  const bool has_argument = option.name.starts_with("-") && !option.argument.empty();
  return fmt::format("{}{}{}{}{}", option.short_name, option.short_name.empty() ? "" : ", ",
                     option.name, has_argument ? " " : "", has_argument ? option.argument : "");
}

std::string usage_of(const CommandText& command) {
  std::string usage = fmt::format("thermedge {} [OPTIONS]", command.name);
  for (const OptionText& positional : command.positionals) {
    const bool is_needed = positional.is_required || positional.name == "INPUT";
    usage += fmt::format(" {}{}{}{}", is_needed ? "" : "[", positional.name,
                         positional.may_repeat ? "..." : "", is_needed ? "" : "]");
  }
  return usage;
}

const std::vector<ExitCode>& exit_codes() {
  static const std::vector<ExitCode> codes = {
      {kGood, "everything was done"},
      {kBadInput,
       "an input could not be read or a result could not be written; the other inputs "
       "were processed"},
      {kBadUsage,
       "the command line, or an option in a file of options, is wrong; nothing was done"},
      {130,
       "Ctrl-C ended the run after the frame that was being processed (143: SIGTERM, 129: SIGHUP); "
       "all results "
       "up to there are whole"}};
  return codes;
}

std::string command_help(const CommandText& command) {
  std::string text = paragraph(fmt::format("thermedge {}: {}", command.name, command.description));
  text += "Usage: " + usage_of(command) + "\n";
  if (!command.positionals.empty()) {
    text += "\nArguments:\n";
  }
  for (const OptionText& positional : command.positionals) {
    text += entry(positional.name, full_help(positional));
  }
  for (const std::string& group : option_groups()) {
    std::string entries;
    for (const OptionText& option : command.options) {
      entries += option.group == group ? entry(names_and_argument(option), full_help(option)) : "";
    }
    text += entries.empty() ? "" : fmt::format("\n{}:\n{}", group, entries);
  }
  if (command.has_option("--preset")) {
    text += presets();
  }
  if (command.has_option("--config") && command.has_option("--preset")) {
    text += "\n" + paragraph(kPrecedence);
  }
  text += "\nExamples:\n";
  for (const Example& example : examples_of(command.name)) {
    text += fmt::format("  {}\n      {}\n", example.command_line, example.meaning);
  }
  return text;
}

std::string program_help(const CommandText& program, const std::vector<CommandText>& commands) {
  std::string text = paragraph(program.description);
  text += "Usage: thermedge COMMAND [OPTIONS] ...\n\nCommands:\n";
  for (const CommandText& command : commands) {
    text += entry(command.name, command.description);
  }
  text += "\nOptions:\n";
  for (const OptionText& option : program.options) {
    text += entry(names_and_argument(option), full_help(option));
  }
  text += "\nExit codes:\n";
  for (const ExitCode& code : exit_codes()) {
    text += entry(std::to_string(code.code), code.meaning);
  }
  text += "\nExamples:\n";
  for (const char* command : {"detect", "probe"}) {
    const Example example = examples_of(command).front();
    text += fmt::format("  {}\n      {}\n", example.command_line, example.meaning);
  }
  return text + "\nthermedge COMMAND --help, or thermedge help COMMAND, tells of one command.\n";
}

}  // namespace thermedge::cli
