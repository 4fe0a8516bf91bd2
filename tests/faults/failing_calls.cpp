// SPDX-License-Identifier: BSD-3-Clause
// A library to preload: the n-th call of one kind that a program makes fails, as it would on a machine in trouble.
//
// FAULT_PROGRAM  the file name of the program meant; others, such as its children, are left alone
// FAULT_CALL     allocate, open, read, write, sync, rename or mkdir
// FAULT_AT       which call, from 1; 0: none, they are counted only
// FAULT_KIND     ENOSPC, EIO, EINTR; full: ENOSPC from this call on; short: half of the bytes are taken; for
// allocations
//                once: this one, on: this one and all behind it
// FAULT_FOLDER   files elsewhere are left alone; standard output is not
// FAULT_LIBRARY  allocations: part of a library's file name; only what it asks for is counted and fails
// FAULT_TALLY    a file that receives a Tally
//
// Counting begins with main(): what libraries do before is not the program's, nor is what they do while they are
// loaded. Allocations of the GL driver are left alone too, for it does not check them.
#include "tests/faults/tally.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>
#include <unwind.h>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

using meniscus::test::Tally;

constexpr const char* kDriver[] = {"libLLVM", "_dri.so", "libgallium", "libEGL", "libGL",      "libglapi", "libepoxy",
                                   "libdrm",  "libz3",   "libX",       "libxcb", "libwayland", "ld-linux"};

struct Settings {
  const char* call = "";
  const char* kind = "";
  const char* folder = "";
  const char* library = "";
  std::uint64_t at = 0;
  Tally* tally = nullptr;
};

Settings settings;
std::atomic<bool> active{false};
__attribute__((tls_model("initial-exec"))) thread_local bool inside = false;  // true in calls of this library itself

const char* variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

void start() {
  char program[4096] = {};
  if (::readlink("/proc/self/exe", program, sizeof program - 1) < 0) return;
  const char* name = std::strrchr(program, '/');
  if (!name || std::strcmp(name + 1, variable("FAULT_PROGRAM")) != 0) return;
  settings = {variable("FAULT_CALL"),
              variable("FAULT_KIND"),
              variable("FAULT_FOLDER"),
              variable("FAULT_LIBRARY"),
              std::strtoull(variable("FAULT_AT"), nullptr, 10),
              nullptr};
  const int file = ::open(variable("FAULT_TALLY"), O_RDWR | O_CREAT, 0600);
  if (file < 0 || ::ftruncate(file, sizeof(Tally)) != 0) ::abort();
  void* const memory = ::mmap(nullptr, sizeof(Tally), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) ::abort();
  ::close(file);
  settings.tally = static_cast<Tally*>(memory);
  active = true;
}

bool is_kind(const char* kind) { return std::strcmp(settings.kind, kind) == 0; }

// Returns whether this call must fail.
bool due(const char* call, std::uint64_t* number = nullptr) {
  if (!active || inside || std::strcmp(settings.call, call) != 0) return false;
  const std::uint64_t n = std::atomic_ref(settings.tally->calls).fetch_add(1) + 1;
  if (number) *number = n;
  const bool goes_on = is_kind("on") || is_kind("full");
  const bool now = settings.at > 0 && (n == settings.at || (n > settings.at && goes_on));
  if (now) settings.tally->failed = 1;
  return now;
}

int error_of_kind() {
  if (is_kind("ENOSPC") || is_kind("full")) return ENOSPC;
  return is_kind("EINTR") ? EINTR : EIO;
}

bool concerns(const char* path) { return std::strncmp(path, settings.folder, std::strlen(settings.folder)) == 0; }

bool concerns(int descriptor) {
  if (!active) return false;
  char name[64], path[4096] = {};
  std::snprintf(name, sizeof name, "/proc/self/fd/%d", descriptor);
  return ::readlink(name, path, sizeof path - 1) > 0 && concerns(path);
}

template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

// --- allocations

enum class Owner { others, driver, library };

struct Module {
  std::uintptr_t begin, end;
  Owner owner;
};
std::array<Module, 64> modules;  // those that are not of others
std::atomic<std::size_t> module_count{0};
std::atomic<unsigned long long> modules_seen{0};

Owner owner_of(const char* module) {
  if (*settings.library && std::strstr(module, settings.library)) return Owner::library;
  for (const char* part : kDriver)
    if (std::strstr(module, part)) return Owner::driver;
  return Owner::others;
}

int note_module(dl_phdr_info* info, std::size_t, void*) {
  modules_seen = info->dlpi_adds;
  const Owner owner = owner_of(info->dlpi_name);
  for (int n = 0; owner != Owner::others && n < info->dlpi_phnum; ++n) {
    const auto& header = info->dlpi_phdr[n];
    const std::uintptr_t begin = info->dlpi_addr + header.p_vaddr;
    if (header.p_type == PT_LOAD && (header.p_flags & PF_X) && module_count < modules.size())
      modules[module_count++] = {begin, begin + header.p_memsz, owner};
  }
  return 0;
}

int note_if_new(dl_phdr_info* info, std::size_t, void* is_new) {
  *static_cast<bool*>(is_new) = info->dlpi_adds != modules_seen;
  return 1;  // Each module has these counts, so the first suffices.
}

void note_new_modules() {
  bool is_new = false;
  ::dl_iterate_phdr(note_if_new, &is_new);
  if (!is_new) return;
  module_count = 0;
  ::dl_iterate_phdr(note_module, nullptr);
}

Owner owner_at(std::uintptr_t place) {
  for (std::size_t n = 0; n < module_count; ++n)
    if (place >= modules[n].begin && place < modules[n].end) return modules[n].owner;
  return Owner::others;
}

/// The innermost callers of an allocation.
struct Stack {
  std::uint64_t hash = 0xcbf29ce484222325;
  int depth = 0;
  bool driver = false, library = false;
};

_Unwind_Reason_Code add_frame(_Unwind_Context* context, void* stack) {
  auto& found = *static_cast<Stack*>(stack);
  const std::uintptr_t place = _Unwind_GetIP(context);
  found.hash = (found.hash ^ place) * 0x100000001b3;
  const Owner owner = owner_at(place);
  found.driver = found.driver || owner == Owner::driver;
  found.library = found.library || owner == Owner::library;
  constexpr int kDeep = 8;
  return ++found.depth < kDeep ? _URC_NO_REASON : _URC_END_OF_STACK;
}

// Notes the first call from each stack, so that a test can take one of each.
void note_place(const Stack& stack, std::uint64_t number) {
  static std::array<std::uint64_t, 1 << 18> known;
  for (std::size_t slot = stack.hash % known.size();; slot = (slot + 1) % known.size()) {
    if (known[slot] == stack.hash) return;
    if (known[slot] != 0) continue;
    known[slot] = stack.hash;
    break;
  }
  Tally& tally = *settings.tally;
  if (tally.places < tally.first.size()) tally.first[tally.places++] = number;
}

bool refuse_allocation() {
  if (!active || inside || std::strcmp(settings.call, "allocate") != 0) return false;
  inside = true;
  note_new_modules();
  Stack stack;
  _Unwind_Backtrace(add_frame, &stack);
  inside = false;
  if (stack.driver || (*settings.library && !stack.library)) return false;
  std::uint64_t number = 0;
  const bool refused = due("allocate", &number);
  if (settings.at == 0) note_place(stack, number);
  if (refused) errno = ENOMEM;
  return refused;
}

/// Allocates by the standard's rule: the program's handler is called for as long as it returns.
void* allocate_or_throw(std::size_t size, std::size_t alignment) {
  while (true) {
    void* const memory =
        refuse_allocation() ? nullptr : (alignment ? __libc_memalign(alignment, size ? size : 1) : __libc_malloc(size));
    if (memory) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (!handler) throw std::bad_alloc();
    handler();
  }
}

int (*program_main)(int, char**, char**) = nullptr;

int counted_main(int argc, char** argv, char** environment) {
  start();
  return program_main(argc, argv, environment);
}

}  // namespace

void* operator new(std::size_t size) { return allocate_or_throw(size, 0); }
void* operator new[](std::size_t size) { return allocate_or_throw(size, 0); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return refuse_allocation() ? nullptr : __libc_malloc(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return refuse_allocation() ? nullptr : __libc_malloc(size);
}

extern "C" {

void* malloc(std::size_t size) { return refuse_allocation() ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) { return refuse_allocation() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* memory, std::size_t size) { return refuse_allocation() ? nullptr : __libc_realloc(memory, size); }
void* memalign(std::size_t alignment, std::size_t size) {
  return refuse_allocation() ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return refuse_allocation() ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = refuse_allocation() ? nullptr : __libc_memalign(alignment, size);
  return *memory ? 0 : ENOMEM;
}

int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if (flags & (O_CREAT | __O_TMPFILE)) {
    va_list more;
    va_start(more, flags);
    mode = static_cast<mode_t>(va_arg(more, int));
    va_end(more);
  }
  if (active && concerns(path) && due("open")) return errno = error_of_kind(), -1;
  return next<int(const char*, int, ...)>("open")(path, flags, mode);
}

ssize_t read(int descriptor, void* bytes, std::size_t count) {
  if (concerns(descriptor) && due("read")) {
    if (!is_kind("short")) return errno = error_of_kind(), -1;
    count = (count + 1) / 2;
  }
  return next<ssize_t(int, void*, std::size_t)>("read")(descriptor, bytes, count);
}

ssize_t pread(int descriptor, void* bytes, std::size_t count, off_t offset) {
  if (concerns(descriptor) && due("read")) {
    if (!is_kind("short")) return errno = error_of_kind(), -1;
    count = (count + 1) / 2;
  }
  return next<ssize_t(int, void*, std::size_t, off_t)>("pread")(descriptor, bytes, count, offset);
}

ssize_t write(int descriptor, const void* bytes, std::size_t count) {
  if (concerns(descriptor) && due("write")) {
    if (!is_kind("short")) return errno = error_of_kind(), -1;
    count = (count + 1) / 2;
  }
  return next<ssize_t(int, const void*, std::size_t)>("write")(descriptor, bytes, count);
}

int fsync(int descriptor) {
  if (concerns(descriptor) && due("sync")) return errno = error_of_kind(), -1;
  return next<int(int)>("fsync")(descriptor);
}

void* dlopen(const char* file, int flags) {
  static const auto original = next<void*(const char*, int)>("dlopen");
  const bool was_inside = inside;
  inside = true;
  void* const handle = original(file, flags);
  inside = was_inside;
  return handle;
}

int rename(const char* from, const char* to) {
  if (active && concerns(to) && due("rename")) return errno = error_of_kind(), -1;
  return next<int(const char*, const char*)>("rename")(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  if (active && concerns(to) && due("rename")) return errno = error_of_kind(), -1;
  return next<int(int, const char*, int, const char*, unsigned)>("renameat2")(from_folder, from, to_folder, to, flags);
}

int mkdir(const char* path, mode_t mode) {
  if (active && concerns(path) && due("mkdir")) return errno = error_of_kind(), -1;
  return next<int(const char*, mode_t)>("mkdir")(path, mode);
}

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(), void (*fini)(),
                      void (*rtld_fini)(), void* stack_end) {
  program_main = main;
  return next<int(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(), void (*)(), void*)>(
      "__libc_start_main")(counted_main, argc, argv, init, fini, rtld_fini, stack_end);
}

}  // extern "C"
