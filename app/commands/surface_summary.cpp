// SPDX-License-Identifier: BSD-3-Clause
// Computes the files of `meniscus surface --csv-summary` in a pipeline; a later call can continue its tables.
#include "app/commands/picture_sink.h"
#include "app/commands/surface_command.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "app/process/program_main.h"
#include "app/reports/csv_tables.h"
#include "app/reports/notes.h"
#include "app/reports/run_frames.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

/// Returns the first cell of a row.
std::string first_cell(const std::string& row) {
  const std::size_t begin = row.starts_with('"') ? row.find("\",") + 1 : 0;
  return row.substr(0, row.find(',', begin));
}

/// Returns true for a row of a summary whose file was computed.
bool is_whole(const std::string& row) { return row.ends_with(",yes,\n"); }

/// A table that keeps its rows as they come, and that a later call can continue.
class LastingTable {
 public:
  /// path: empty: no table is written. note: a first line that the finished table does not have; empty: none.
  LastingTable(const std::string& path, std::string note, std::string header)
      : path_(path), part_(path + ".part"), note_(std::move(note)), header_(std::move(header)) {}

  bool is_wanted() const { return !path_.empty(); }
  bool has_part() const { return is_wanted() && fs::exists(part_); }

  /// Begins with those existing complete rows for which `kept` is true.
  template <typename Kept>
  void begin(const Kept& kept) {
    if (!is_wanted()) return;
    OutputFile begun(part_, Existing::replace);
    begun.write(note_.empty() ? header_ : note_ + "\n" + header_);
    std::ifstream old(part_, std::ios::binary);
    for (std::string line; std::getline(old, line) && !old.eof();)
      if (line += "\n"; line != header_ && kept(line)) begun.write(line);
    begun.commit();
    file_.open(part_, std::ios::binary | std::ios::app);
    check();
  }

  void add(const std::string& rows) {
    if (!is_wanted()) return;
    file_ << rows << std::flush;
    check();
  }

  void finish(Existing existing) {
    if (!is_wanted()) return;
    file_.close();
    check();
    OutputFile whole(path_, existing);
    std::ifstream part(part_, std::ios::binary);
    std::string line;
    if (!note_.empty()) std::getline(part, line);
    constexpr std::size_t kPiece = std::size_t{1} << 20;
    std::string piece(kPiece, '\0');
    while (part.read(piece.data(), kPiece) || part.gcount() > 0)
      whole.write(std::string_view(piece.data(), static_cast<std::size_t>(part.gcount())));
    whole.commit();
    part.close();
    fs::remove(part_);
  }

  const std::string& note() const { return note_; }
  const std::string& part() const { return part_; }

 private:
  void check() const {
    if (!file_) throw OutputError(part_, std::string("cannot be written: ") + std::strerror(errno));
  }

  std::string path_, part_, note_, header_;
  std::ofstream file_;
};

/// The result of a file.
struct SummarizedFile {
  std::size_t number = 0;
  std::string row, atoms, residues;
  std::optional<std::pair<ExitCode, std::string>> failure;
  double milliseconds = 0.0;
};

class Summary {
 public:
  Summary(const SurfaceCommand& command, std::vector<std::string> files)
      : command_(command),
        files_(std::move(files)),
        summary_(command.summary_csv,
                 fmt::format("#{}{}{}", made_of(command.scene), command.atom_csv.empty() ? "" : " atoms",
                             command.residue_csv.empty() ? "" : " residues"),
                 summary_header()),
        atoms_(command.atom_csv, "", "file," + atom_csv_header(columns_of({}))),
        residues_(command.residue_csv, "",
                  "file," + residue_csv_header(columns_of({}), command.scene.molecule.surface.probe_radius)) {
    command_.scene.molecule.surface.cpu = true;  // a context for each file would cost more than most of the files
  }

  void make() {
    begin_tables();
    const std::size_t at_once = files_at_once();
    RunProgress progress(command_.reporting.progress, command_.reporting.quiet, files_.size(), at_once, "file");
    std::size_t next = 0;
    tbb::parallel_pipeline(at_once,
                           tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order,
                                                               [&](tbb::flow_control& flow) {
                                                                 if (next == files_.size()) flow.stop();
                                                                 return next++;
                                                               }) &
                               tbb::make_filter<std::size_t, std::shared_ptr<SummarizedFile>>(
                                   tbb::filter_mode::parallel, [&](std::size_t number) { return computed(number); }) &
                               tbb::make_filter<std::shared_ptr<SummarizedFile>, void>(
                                   tbb::filter_mode::serial_in_order,
                                   [&](const std::shared_ptr<SummarizedFile>& file) { keep(*file, progress); }));
    progress.end();
    for (LastingTable* table : {&atoms_, &residues_, &summary_}) table->finish(command_.existing());
    if (failed_ == 0) return;
    throw RunError(first_failure_->first, "{} of {} files failed; the first: {}", with_thousands(failed_),
                   with_thousands(files_.size()), first_failure_->second);
  }

 private:
  std::vector<AreaColumn> columns_of(const std::vector<SurfaceObject>& objects) const {
    return area_totals(objects, command_.scene.molecule.surface.kind);
  }

  std::string summary_header() const {
    std::string header = "file,atoms";
    for (const SeriesValue& value : series_values({}, columns_of({}))) header += "," + value.name;
    return header + ",exact_within,closed,error\n";
  }

  void begin_tables() {
    std::set<std::string> done;
    if (command_.resumes) {
      std::ifstream old(summary_.part());
      std::string line;
      if (std::getline(old, line) && line != summary_.note())
        throw UsageError(
            "--resume: {} was begun with other options or by another version; choose another name, or leave --resume "
            "out and add --force to begin again",
            escaped(summary_.part()));
      while (std::getline(old, line) && !old.eof())
        if (is_whole(line + "\n")) done.insert(first_cell(line));
      std::error_code ignored;  // a missing file has failed, or will fail
      const fs::file_time_type written = fs::last_write_time(summary_.part(), ignored);
      for (const std::string& file : files_)
        if (fs::last_write_time(file, ignored) > written) done.erase(csv_cell(file));
    } else if (summary_.has_part() && !command_.force) {
      throw UsageError(
          "{} is there, of a call that did not come to its end; add --resume to continue it, or --force "
          "to begin anew",
          escaped(summary_.part()));
    }
    const auto is_done = [&](const std::string& row) { return done.contains(first_cell(row)); };
    atoms_.begin(is_done);
    residues_.begin(is_done);
    summary_.begin([&](const std::string& row) { return is_whole(row) && is_done(row); });
    if (!command_.resumes) return;
    const std::size_t all = files_.size();
    std::erase_if(files_, [&](const std::string& file) { return done.contains(csv_cell(file)); });
    log_line(command_, fmt::format("--resume: {} of {} files are there", with_thousands(all - files_.size()),
                                   with_thousands(all)));
  }

  std::size_t files_at_once() const {
    if (command_.jobs > 0) return command_.jobs;
    if (memory_is_limited()) return 1;
    const int threads = command_.scene.molecule.surface.threads;
    return static_cast<std::size_t>(threads > 0 ? threads : tbb::info::default_concurrency());
  }

  std::shared_ptr<SummarizedFile> computed(std::size_t number) const {
    auto file = std::make_shared<SummarizedFile>();
    file->number = number;
    const auto begin = std::chrono::steady_clock::now();
    // While it waits for its parts, this thread begins no other file, because memory is limited to the files at work.
    tbb::this_task_arena::isolate([&] {
      try {
        compute(*file);
      } catch (const std::exception& error) {
        fail(*file, error);
      }
    });
    file->milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    return file;
  }

  void compute(SummarizedFile& file) const {
    MoleculeRequest request = command_.scene.molecule;
    request.file = files_[file.number];
    const Molecule molecule = MoleculeBuilder(request).build(read_molecule(request));
    const bool by_atom = atoms_.is_wanted() || residues_.is_wanted();
    const std::vector<AreaColumn> columns =
        by_atom ? area_columns(molecule.structure, molecule.objects, request.surface.kind)
                : columns_of(molecule.objects);
    const std::string name = csv_cell(request.file) + ",";
    file.row = name + std::to_string(molecule.structure.atoms.size());
    for (const SeriesValue& value : series_values(molecule, columns))
      file.row += fmt::format(",{:.{}f}", value.value, *value.unit ? 6 : 0);
    file.row += fmt::format(",{},yes,\n", change_of_radii(molecule.objects).exact_within);
    if (atoms_.is_wanted()) file.atoms = atom_csv_rows(molecule.structure, columns, name);
    if (residues_.is_wanted())
      file.residues = residue_csv_rows(molecule.structure, columns, request.surface.probe_radius, name);
  }

  void fail(SummarizedFile& file, const std::exception& error) const {
    const std::size_t values = series_values({}, columns_of({})).size();
    const bool is_open = dynamic_cast<const OpenSurfaceError*>(&error) != nullptr;
    file.row = fmt::format("{},{},,{},{}\n", csv_cell(files_[file.number]), std::string(values, ','),
                           is_open ? "no" : "", csv_cell(error.what()));
    file.failure.emplace(exit_code_of(error), error.what());
  }

  void keep(const SummarizedFile& file, RunProgress& progress) {
    atoms_.add(file.atoms);
    residues_.add(file.residues);
    summary_.add(file.row);
    if (!file.failure) return progress.done(file.number, {}, file.milliseconds);
    if (failed_++ == 0) first_failure_ = file.failure;
    progress.failed(file.number, file.failure->first, file.failure->second);
  }

  SurfaceCommand command_;
  std::vector<std::string> files_;
  LastingTable summary_, atoms_, residues_;
  std::size_t failed_ = 0;
  std::optional<std::pair<ExitCode, std::string>> first_failure_;
};

/// Throws for options that need one molecule, or a run.
void check_summary(const SurfaceCommand& command) {
  const Scene& scene = command.scene;
  const std::pair<bool, const char*> others[] = {{command.json, "--json"},
                                                 {!command.series_csv.empty(), "--csv-series"},
                                                 {!command.cavity_csv.empty(), "--csv-cavities"},
                                                 {!command.gradient_csv.empty(), "--gradients"},
                                                 {!command.patch_csv.empty(), "--csv-patches"},
                                                 {!command.plot.empty(), "--plot"},
                                                 {command.open_sky, "--open-sky"},
                                                 {command.context.has_value(), "--context"},
                                                 {scene.frames.is_requested(), "--frames, or another option for runs"}};
  for (const auto& [is_given, option] : others)
    if (is_given) throw UsageError("--csv-summary is for many molecules, one row each; leave {} out", option);
  for (const std::string& path : {command.summary_csv, command.atom_csv, command.residue_csv}) {
    if (path == "-")
      throw UsageError(
          "--csv-summary and its tables must be files, so that --resume can continue them; give a name instead of -");
    if (path.empty()) continue;
    check_output(path, command.existing());
    check_output(path + ".part", Existing::replace);
  }
}

}  // namespace

void print_summary(const SurfaceCommand& requested) {
  SurfaceCommand command = requested;
  std::vector<std::string> files{std::exchange(command.scene.molecule.file, {})};
  std::vector<std::string>& more = command.scene.frames.trajectories;
  files.insert(files.end(), more.begin(), more.end());
  more.clear();
  check_summary(command);
  for (const std::string& file : files)
    if (file == "-") throw UsageError("--csv-summary cannot read standard input (-); give names of files");
  Summary(command, std::move(files)).make();
}

}  // namespace meniscus
