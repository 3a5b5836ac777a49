/* `cleave bench sif`: compares stress-intensity factors with closed forms and published tables: an edge crack, an
 * inclined crack, cracks under plane waves, stationary and running, and reactions and paths of growing cracks. */
#include "sif_bench.h"

static const char *const needed[] = {"inputs/edge_crack_k1.yaml", "inputs/inclined_crack.yaml",
                                     "inputs/semi_infinite_crack.yaml", "inputs/load_displacement.yaml",
                                     "inputs/kalthoff_sif.yaml"};

status bench_sif(bool quick)
{
    struct bench_goals asked = {0};
    TRY(bench_check_scenes_exist("sif", needed, COUNT_OF(needed)));
    printf("stress-intensity factors\n");
    bench_print_machine(threads_set_count_and_bind_to_cores(0));
    TRY(edge_crack_bench(&asked, quick));
    TRY(inclined_crack_bench(&asked, quick));
    TRY(moving_crack_bench(&asked, quick));
    if (!quick) TRY(growing_cracks_bench(&asked));
    bench_goals_print(&asked);
    return bench_goals_write("sif", &asked);
}
