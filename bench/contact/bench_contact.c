/* `cleave bench contact`. */
#include <math.h>
#include <stdio.h>

#include "contact_bench.h"

status bench_contact(bool quick)
{
    (void)quick;
    static const char *const law[] = {"surface", "pair"};
    static const double offset[] = {0, 0.5, 1, 1.5}, radius[] = {20, 40};
    printf("%-8s %4s %6s %7s %6s  %9s %9s %9s %9s %9s\n", "law", "R/D", "b/R", "v/c", "turn", "restitut.", "tangent.",
           "spin", "energy", "overlap");
    for (size_t l = 0; l < COUNT_OF(law); l++)
        for (size_t r = 0; r < COUNT_OF(radius); r++)
            for (size_t o = 0; o < COUNT_OF(offset); o++)
                for (int k = 0; k < 3; k++)
                    for (int t = 0; t < 2; t++) {
                        if ((o > 0 && k != 1) || (r == 1 && (k != 1 || quick))) continue;
                        const double speed = k == 0 ? 1e-3 : k == 1 ? 1e-2 : 5e-2;
                        struct contact_discs c = {.law = law[l], .model = "bond", .radius = radius[r], .speed = speed,
                                                  .offset = offset[o], .turn = t ? asin(0.5 * offset[o]) : 0};
                        if (t && o == 0) continue;
                        const status ran = contact_discs_run(&c);
                        if (ran != OK) printf("%s\n", status_message());
                        printf("%-8s %4g %6g %7g %6.3f  %9.4f %9.4f %9.5f %9.1e %9.4f\n", law[l], radius[r], offset[o],
                               speed, c.turn, c.restitution, c.tangential, c.spin, c.energy, c.overlap);
                        fflush(stdout);
                    }
    return OK;
}
