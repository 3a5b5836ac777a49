/* Tests nested trial equilibria of load steps. The end of each restores the plastic state of bonds at its beginning,
 * also as the start of further solutions. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

#include "base/memory.h"
#include "engine/engine.h"
#include "src/quasistatic/system.h"
#include "src/quasistatic/trial.h"
#include "scene/scene_read.h"

static const char plate[] =
    "space: plane stress\nthickness: 3 mm\nduration: 2 s\nmethod: pd\nsolver: static\nsteps: {number: 2}\n"
    "material: {young: 70 GPa, density: 2700 kg/m^3, critical_stretch: 0.1, yield_stress: 200 MPa}\n"
    "body: {box: {from: [0, 0], to: [8 mm, 6 mm]}}\nparticles: {spacing: 1 mm, horizon: 3.015}\n"
    "boundary:\n  - {fixed: all, region: {box: {from: [0, 0], to: [2 mm, 6 mm]}}}\n"
    "  - {traction: [1 MPa, 0], face: x+, time: {ramp: {until: 2 s}}}\noutput: {frames: 0}\n";

/* Returns the number of bond slots in the row blocks of the run (eight per column, also empty ones). */
static int64_t bond_slots(const struct run *run) { return run->bonds.columns * LANES; }

/* Adds `more` to the plastic stretch of all bonds of the run [1]. */
static void flow(struct run *run, real more)
{
    for (int64_t q = 0; q < bond_slots(run); q++) run->bonds.plastic_stretch[q] += more;
}

/* Fails unless every bond of the run has the plastic stretch `stretch` [1]. */
static void expect(const struct run *run, real stretch)
{
    for (int64_t q = 0; q < bond_slots(run); q++) assert_true(run->bonds.plastic_stretch[q] == stretch);
}

static void test_trial_within_trial(void **state)
{
    struct scene s = {0};
    struct run e = {0};
    struct memory_archive outer, inner;
    (void)state;
    if (scene_read_text(&s, plate, strlen(plate), "plate.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    if (run_set_up_from_scene(&e, &s, NULL) != OK || run_advance_to_end_time(&e) != OK)
        fail_msg("%s", status_message());
    assert_true(bond_slots(&e) > 0);
    array_fill_bytes(e.bonds.plastic_stretch, 0, bond_slots(&e), sizeof *e.bonds.plastic_stretch);
    flow(&e, 0.125);
    trial_equilibrium_begin(&e, &outer);
    flow(&e, 0.25);
    trial_equilibrium_begin(&e, &inner);
    flow(&e, 0.5);
    trial_equilibrium_end(&e, &inner, false, NULL);
    expect(&e, 0.375);
    trial_equilibrium_end(&e, &outer, false, NULL);
    expect(&e, 0.125);
    flow(&e, 0.5);
    plastic_state_restore(&e.statics->plastic, &e.bonds, &e.part, e.optional);
    expect(&e, 0.125); /* the state before the outer trial */
    run_free_memory(&e);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_trial_within_trial)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
