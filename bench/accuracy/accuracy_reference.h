/* Cracks computed by bond-based peridynamics (horizon 3.015, 0.4 of the critical step) at fine spacings: reference
 * values of `cleave bench accuracy=fracture`, printed by `cleave bench accuracy=reference`.
 *
 * Resolution: particles across the plate, from 100 (the spacing of the scenes) to 800. The table is compared with 400.
 * The difference between 400 and 800 is the uncertainty of the reference: for Kalthoff's plate 0.041 rad (2.3 degrees)
 * of the path, 0.02 % of the start time, 1.4 % of the speed, 2.5 % in all; for the plate under tension 2.2 % of the
 * length, 0.8 % of the start time, 0.9 % of the speed, 1.4 % in all. Smaller errors are not significant. */
#ifndef CLEAVE_BENCH_ACCURACY_REFERENCE
#define CLEAVE_BENCH_ACCURACY_REFERENCE

enum { FRACTURE_RINGS = 4, FRACTURE_SPACINGS = 4, FRACTURE_QUARTER = 2 };

/* Growth of the cracks that is observed in a run: start, speed, length and direction. */
struct fracture {
    double start, speed, length;  /* time at which the growth exceeds a threshold [s]; speed afterwards [m/s]; length
                                   * at the end [m] */
    double angle[FRACTURE_RINGS]; /* angle of the path in rings around the start [rad] */
};

static const struct fracture fracture_reference[2][FRACTURE_SPACINGS] = {
    {
        {3.061439e-05, 1283.1, 0.028888, {1.0064, 1.0537, 1.1014, 1.1384}}, /* Kalthoff, 100 */
        {3.020607e-05, 1216.8, 0.029294, {1.1018, 1.1603, 1.184, 1.1917}},  /* Kalthoff, 200 */
        {3.0606e-05, 1233.9, 0.029018, {1.25, 1.2433, 1.2433, 1.2361}},     /* Kalthoff, 400 */
        {3.059838e-05, 1250.6, 0.029375, {1.1784, 1.2092, 1.2253, 1.2274}}, /* Kalthoff, 800 */
    },
    {
        {7.744465e-06, 1306, 0.0037583, {0, 0, 0, 0}},   /* pulled plate, 100 */
        {7.793704e-06, 1297.6, 0.003877, {0, 0, 0, 0}},  /* pulled plate, 200 */
        {7.684277e-06, 1327.3, 0.0044379, {0, 0, 0, 0}}, /* pulled plate, 400 */
        {7.746469e-06, 1339.2, 0.0043439, {0, 0, 0, 0}}, /* pulled plate, 800 */
    },
};

#endif
