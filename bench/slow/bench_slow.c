/* `cleave bench slow`: compares load steps with linear elastic fracture mechanics, the criterion of the largest hoop
 * stress and finite elements, and measures their time. */
#include "slow.h"

static const char *const needed[] = {"inputs/compact_tension.yaml",   "inputs/edge_crack_grips.yaml",
                                     "inputs/cantilevers.yaml",       "inputs/cantilevers_3d.yaml",
                                     "inputs/bend_offset_notch.yaml", "inputs/mixed_mode.yaml"};

status bench_slow(bool quick)
{
    struct bench_goals asked = {0};
    TRY(bench_check_scenes_exist("slow", needed, COUNT_OF(needed)));
    printf("load steps\n");
    bench_print_machine(threads_set_count_and_bind_to_cores(0));
    TRY(slow_run_specimens(&asked, quick));
    TRY(slow_compare_crack_paths(&asked, quick));
    TRY(slow_time_load_steps(&asked, quick));
    bench_goals_print(&asked);
    return bench_goals_write("slow", &asked);
}
