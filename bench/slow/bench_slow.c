/* `cleave bench slow`: compares load steps with linear elastic fracture mechanics, the criterion of the largest hoop
 * stress and finite elements, and measures their time. */
#include "slow.h"

static const char *const needed[] = {"inputs/compact_tension.yaml",   "inputs/edge_crack_grips.yaml",
                                     "inputs/cantilevers.yaml",       "inputs/cantilevers_3d.yaml",
                                     "inputs/bend_offset_notch.yaml", "inputs/mixed_mode.yaml"};

status bench_slow(bool quick)
{
    struct bench_goals asked = {0};
    TRY(bench_scenes_needed("slow", needed, COUNT_OF(needed)));
    printf("load steps\n");
    bench_print_machine(team_set_threads(0));
    TRY(slow_specimens(&asked, quick));
    TRY(slow_paths(&asked, quick));
    TRY(slow_speed(&asked, quick));
    bench_goals_print(&asked);
    return bench_goals_write("slow", &asked);
}
