/* Tests the repulsion of bonds that are compressed below 0.7 of their length: forces against the gradient of the
 * energy, their sum, the closed form of a chain, and no effect above 0.7. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "engine/engine.h"
#include "scene/scene_read.h"
#include "tests/support/near.h"

static const char block[] = "name: squeezed\nspace: plane stress\nthickness: 1\nmethod: pd\nduration: 1\n"
                            "time: {safety: 0.45}\n"
                            "material: {young: 1e4, poisson: 1/3, density: 1}\n"
                            "body: {box: {from: [0, 0], to: [9, 7]}}\nparticles: {spacing: 1}\n";
static const char chain[] = "name: squeezed\nspace: line\nsection: 1\nmethod: pd\nduration: 1\n"
                            "time: {safety: 0.45}\n"
                            "material: {young: 1e4, density: 1}\nbody: {box: {from: [0], to: [20]}}\n"
                            "particles: {spacing: 1, horizon: 1.015}\npd: {surface: none}\n";

static struct run *make(struct scene *s, const char *text, const char *model)
{
    const struct scene_override set = {"model", model};
    struct run *run = NEW("test.engine", 1, struct run);
    if (scene_read_text(s, text, strlen(text), "squeezed.yaml", &set, 1) != OK) fail_msg("%s", status_message());
    assert_ok(run_set_up_from_scene(run, s, NULL));
    return run;
}

static void end(struct run *run, struct scene *s)
{
    run_free_memory(run);
    memory_free(run);
    scene_free(s);
}

static real energy_now(struct run *run)
{
    for (int d = 0; d < run->part.dim; d++) memset(run->part.f[d], 0, (size_t)run->part.n * sizeof(real));
    run->kernels.bond_force(&run->bonds, &run->part, &bond_limit_never, NULL);
    return run->kernels.bond_energy(&run->bonds, &run->part, NULL);
}

/* Sets the positions of the run to the reference positions times `share` along x, plus displacements of up to 0.05
 * spacings. */
static void squeeze(struct run *run, real share)
{
    struct particles *p = &run->part;
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < p->dim; d++)
            p->x[d][i] = (d == 0 ? share : 1) * p->X[d][i] + 0.05 * sin(12.9 * (double)i + 78.2 * d);
}

/* Compares the forces of the model `model` with repulsion with central differences of the energy over 1e-5 of a
 * spacing. Tolerance 1e-5 K: where the repulsion begins the second derivative jumps by 3 K. */
static void check_gradient(const char *model)
{
    struct scene s;
    struct run *run = make(&s, block, model);
    struct particles *p = &run->part;
    squeeze(run, 0.45);
    for (int64_t i = 0; i < p->n; i += 5)
        for (int d = 0; d < p->dim; d++) {
            const real x = p->x[d][i], h = 1e-5;
            p->x[d][i] = x + h;
            const real above = energy_now(run);
            p->x[d][i] = x - h;
            const real below = energy_now(run);
            p->x[d][i] = x;
            energy_now(run);
            assert_near(p->f[d][i], (below - above) / (2 * h), 1e-5 * 1e4);
        }
    real sum[DIM_MAX] = {0};
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < p->dim; d++) sum[d] += p->f[d][i];
    for (int d = 0; d < p->dim; d++) assert_near(sum[d], 0, 1e-10 * 1e4);
    end(run, &s);
}

static void forces_are_the_gradient(void **state)
{
    (void)state;
    check_gradient("bond");
    check_gradient("ospd");
    check_gradient("mospd");
}

/* Compares the energy of a chain of nearest neighbours compressed to l times its length with its closed form: 1/2 E A/D
 * (1 - l)^2 per bond, plus 3/2 E A/D (0.7 - l)^2 below 0.7, to round-off. A: cross-section, D: spacing. */
static void chain_has_the_closed_form(void **state)
{
    (void)state;
    struct scene s;
    struct run *run = make(&s, chain, "bond");
    struct particles *p = &run->part;
    real k = 0;
    for (real l = 0.95; l > 0.2; l -= 0.05) {
        for (int64_t i = 0; i < p->n; i++) p->x[0][i] = l * p->X[0][i];
        const real energy = energy_now(run) / 19, core = l < 0.7 ? 3 * square(0.7 - l) : 0;
        if (k == 0) k = 2 * energy / square(1 - l);
        assert_near(energy, 0.5 * k * (square(1 - l) + core), 1e-10 * k);
        assert_near(p->f[0][0], -k * (1 - l + (l < 0.7 ? 3 * (0.7 - l) : 0)), 1e-10 * k);
    }
    end(run, &s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(forces_are_the_gradient),
                                       cmocka_unit_test(chain_has_the_closed_form)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
