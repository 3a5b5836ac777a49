/* `cleave info`: prints the build, the versions of its libraries, and the machine. */
#include <errno.h>
#include <hdf5.h>
#include <hwloc.h>
#include <stdio.h>
#include <string.h>
#include <yaml.h>

#include "commands.h"
#include "simd/simd.h"
#include "base/program_commit.h"
#include "base/team.h"

void version_print(FILE *out)
{
    fprintf(out, *program_commit() ? "cleave %s (commit %s)\n" : "cleave %s\n", CLEAVE_VERSION, program_commit());
}

static const char *build_flags(void)
{
#ifdef __OPTIMIZE__
    return "optimised";
#else
    return "not optimised";
#endif
}

static void print_bytes(const char *label, int64_t bytes)
{
    double shown = (double)bytes;
    const char *unit = "kB";
    if (bytes <= 0) {
        printf("%-18s unknown\n", label);
        return;
    }
    shown /= 1024;
    if (shown >= 1024) shown /= 1024, unit = "MB";
    if (shown >= 1024) shown /= 1024, unit = "GB";
    printf("%-18s %.4g %s\n", label, shown, unit);
}

static void print_build(void)
{
    unsigned major, minor, release, hwloc = hwloc_get_api_version();
    H5get_libversion(&major, &minor, &release);
    printf("%-18s %s\n", "cleave", CLEAVE_VERSION);
    if (*program_commit()) printf("%-18s %s\n", "commit", program_commit());
    printf("%-18s %s\n", "compiler", compiler_name());
    printf("%-18s %s, %s precision\n", "build", build_flags(), sizeof(real) == sizeof(double) ? "double" : "single");
    printf("%-18s OpenMP %d, HDF5 %u.%u.%u, libyaml %s, hwloc interface %u.%u\n", "libraries", _OPENMP, major, minor,
           release, yaml_get_version_string(), hwloc >> 16, hwloc >> 8 & 0xff);
}

/* Prints the sets of kernels of this build (the machine instructions for which the loops are compiled), one per line,
 * beginning with the one in use. */
static void print_kernels(void)
{
    printf("%-18s %s: %s\n", "kernels", simd_current_kernels()->name, simd_current_kernels()->meaning);
    for (const struct simd_set *s = simd_sets; s < simd_sets + simd_set_count; s++)
        if (s != simd_current_kernels())
            printf("%-18s %s: %s%s\n", "", s->name, s->meaning, s->runs() ? "" : "; not on this processor");
}

static void print_machine(void)
{
    struct machine m = machine_properties();
    printf("%-18s %s\n", "processor", m.model);
    print_kernels();
    printf("%-18s %d\n", "cores", m.cores);
    printf("%-18s %d; the hardware allows %d\n", "threads of a run", threads_set_count_and_bind_to_cores(0),
           m.threads_allowed);
    print_bytes("L1 data cache", m.cache[1]);
    print_bytes("L2 cache", m.cache[2]);
    print_bytes("L3 cache", m.cache[3]);
    print_bytes("memory", m.memory);
}

status command_info_main(int argc, char **argv)
{
    if (argc > 1) return status_set(REFUSED, "info: takes no arguments; remove %s", argv[1]);
    print_build();
    print_machine();
    if (fflush(stdout) != 0 || ferror(stdout)) return status_set(FAILED, "standard output: %s", strerror(errno));
    return OK;
}
