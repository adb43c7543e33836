// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/surface/readers/isolated_reader.h>
#include <strait/surface/readers/map_message.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>

namespace strait
{
  namespace
  {
    /** An open file, closed when it goes out of scope; not handed to other programs. */
    class Descriptor
    {
    public:
      explicit Descriptor(const int number_)
        : number(number_)
      {
      }

      ~Descriptor()
      {
        close();
      }

      Descriptor(const Descriptor &)            = delete;
      Descriptor &operator=(const Descriptor &) = delete;

      void
      close()
      {
        if (number >= 0)
          ::close(number);
        number = -1;
      }

      operator int() const
      {
        return number;
      }

    private:
      int number;
    };

    /** A process of ours, ended when it goes out of scope. */
    class Child
    {
    public:
      explicit Child(const pid_t id_)
        : id(id_)
      {
      }

      ~Child()
      {
        if (id <= 0)
          return;
        kill(id, SIGKILL);
        wait();
      }

      Child(const Child &)            = delete;
      Child &operator=(const Child &) = delete;

      /** How it ended; nothing if that is not to be known, as where SIGCHLD is ignored.
       */
      std::optional<int>
      wait()
      {
        int   status = 0;
        pid_t ended  = 0;
        do
          ended = waitpid(id, &status, 0);
        while (ended < 0 && errno == EINTR);
        const bool is_known = ended == id;
        id                  = -1;
        return is_known ? std::optional<int>(status) : std::nullopt;
      }

    private:
      pid_t id;
    };

    void
    limit(const int resource, const rlim_t amount)
    {
      rlimit limits{};
      getrlimit(static_cast<__rlimit_resource>(resource), &limits);
      limits.rlim_cur = std::min(limits.rlim_cur, amount);
      setrlimit(static_cast<__rlimit_resource>(resource), &limits);
    }

    /** Bytes that this process may write to as yet: what RLIMIT_DATA counts. */
    rlim_t
    memory_in_use()
    {
      std::ifstream statm("/proc/self/statm");
      rlim_t        pages = 0;
      for (int column = 0; column < 6; ++column)
        statm >> pages;
      return statm ? pages * sysconf(_SC_PAGESIZE) : RLIM_INFINITY;
    }

    /** What MPI and this program do at a signal is not for the child. */
    void
    reset_signals()
    {
      for (int number = 1; number < NSIG; ++number)
        std::signal(number, SIG_DFL);
      // A terminal sends these to all processes; the parent sees to them.
      for (const int number : {SIGINT, SIGTERM, SIGUSR1})
        std::signal(number, SIG_IGN);
      sigset_t none;
      sigemptyset(&none);
      sigprocmask(SIG_SETMASK, &none, nullptr);
    }

    /** Let this process die alone, soon, silently, and not before its time. */
    void
    settle_in(const pid_t parent, const int printed, const IsolatedFile &file)
    {
      reset_signals();
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent)
        _exit(0);
      // If memory runs out it is this process that has to go.
      const Descriptor score(open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC));
      if (score >= 0 && write(score, "1000", 4) < 0)
        errno = 0;
      prctl(PR_SET_DUMPABLE, 0); // no core of it
      constexpr rlim_t most_printed = 1U << 20;
      limit(RLIMIT_FSIZE, most_printed);
      limit(RLIMIT_CPU, file.seconds);
      if (const rlim_t used = memory_in_use(); file.memory < RLIM_INFINITY - used)
        limit(RLIMIT_DATA, used + file.memory);
      // The C library has a word to say about a spoilt heap.
      dup2(printed, STDOUT_FILENO);
      dup2(printed, STDERR_FILENO);
    }

    MapMessage
    answer(const std::function<HeightMap()> &read)
    {
      using Kind = MapMessage::Kind;
      try
        {
          return {Kind::map, read()};
        }
      catch (const InputError &error)
        {
          return {Kind::input_error, {}, error.what()};
        }
      catch (const std::bad_alloc &)
        {
          return {Kind::out_of_memory};
        }
      catch (const std::exception &error)
        {
          return {Kind::other_error, {}, error.what()};
        }
      catch (...)
        {
          return {Kind::other_error, {}, "A library failed without saying why."};
        }
    }

    std::string
    content_of(const int file)
    {
      std::string   text(10000, '\0');
      const ssize_t n = pread(file, text.data(), text.size(), 0);
      text.resize(std::max<ssize_t>(n, 0));
      return text;
    }

    /** Of a process that ended without an answer. */
    [[noreturn]] void
    explain(const IsolatedFile &file, const std::optional<int> &status, const int printed)
    {
      const std::string remedy = "; copy or export it again.";
      const std::string damaged =
        "is damaged: the " + file.library + " library failed to read it";
      if (!status || *status == 0) // what came made no sense
        reject_height_map(file.name, damaged + remedy);
      if (WIFEXITED(*status))
        throw ComputationError(
          "The process that read the height map '" + file.name + "' ended with status " +
          std::to_string(WEXITSTATUS(*status)) + ". " + content_of(printed));
      const int number = WTERMSIG(*status);
      if (number == SIGXCPU)
        reject_height_map(file.name,
                          "is damaged: the " + file.library +
                            " library was still reading it after " +
                            std::to_string(file.seconds) + " s of computing" + remedy);
      if (number == SIGKILL)
        throw ComputationError("The process that read the height map '" + file.name +
                               "' was killed, as happens when the memory of this machine "
                               "does not suffice.");
      reject_height_map(file.name,
                        damaged + " (signal " + std::to_string(number) + ")" + remedy);
    }

    [[noreturn]] void
    give_up(const IsolatedFile &file)
    {
      throw ComputationError("No process could be started to read the height map '" +
                             file.name + "' (" + std::strerror(errno) + ").");
    }
  } // namespace

  IsolatedFile::IsolatedFile(const std::string &name_, const std::string &library_)
    : name(name_)
    , library(library_)
  {
    std::error_code      failure;
    const std::uintmax_t size = std::filesystem::file_size(name, failure);
    if (failure)
      return;
    constexpr std::uintmax_t longest = std::numeric_limits<int>::max();
    seconds += static_cast<unsigned int>(std::min(size / 100000, longest));
    // Bytes may become doubles, and these be transposed.
    memory += 2 * sizeof(double) * largest_compression * size;
  }

  HeightMap
  read_isolated(const IsolatedFile &file, const std::function<HeightMap()> &read)
  {
    int ends[2] = {-1, -1};
    if (pipe2(ends, O_CLOEXEC) != 0)
      give_up(file);
    Descriptor       from(ends[0]), to(ends[1]);
    const Descriptor printed(memfd_create("strait-reader", MFD_CLOEXEC));
    const pid_t      parent = getpid();
    const pid_t      id     = printed < 0 ? -1 : fork();
    if (id < 0)
      give_up(file);
    if (id == 0)
      {
        from.close();
        settle_in(parent, printed, file);
        // No destructors, no handlers, no buffers: all of these are the parent's.
        send(to, answer(read));
        _exit(0);
      }
    Child child(id);
    to.close();
    std::optional<MapMessage> message = receive(from);
    if (!message)
      {
        from.close(); // or it waits for us
        explain(file, child.wait(), printed);
      }
    child.wait();
    switch (message->kind)
      {
        case MapMessage::Kind::map:
          return std::move(message->map);
        case MapMessage::Kind::input_error:
          throw InputError(message->text);
        case MapMessage::Kind::out_of_memory:
          throw std::bad_alloc();
        default:
          throw ComputationError(message->text);
      }
  }
} // namespace strait
