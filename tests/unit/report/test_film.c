/* Tests animations of report pages. Groups of particles keep area and centre of the body, damaged particles are merged
 * last, and each limit of the size in bytes is kept. Also tests rigid bodies in magnified frames. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "src/report/film.h"

enum { NX = 50, NY = 37, FRAMES = 61 };
static const double H = 0.25e-3;

/* Creates an animation of FRAMES frames of a plate of NX by NY particles. In row 20, particles are damaged from x = 10
 * H on, and belong to a crack from 30 H on. */
static void plate_make(struct run_animation *animation)
{
    *animation = (struct run_animation){.dim = 2, .spacing = H, .frames = FRAMES, .listed = FRAMES, .sets = 1};
    animation->frame = NEW("test.frames", FRAMES, struct animation_frame);
    animation->set = memory_ensure_capacity("test.sets", NULL, 1, sizeof *animation->set);
    struct animation_particle_set *s = animation->set;
    const int n = s->n = NX * NY;
    for (int d = 0; d < 2; d++) s->X[d] = NEW("test.X", n, real);
    s->material = NEW("test.material", n, uint8_t), s->body = NEW("test.body", n, uint8_t);
    s->state = NEW("test.state", n, uint8_t), s->history = NEW("test.history", n, uint32_t);
    s->level = NEW("test.level", n, uint8_t), s->first = NEW("test.first", n + 1, int32_t);
    s->member = NEW("test.member", n, int32_t);
    for (int i = 0; i < n; i++) {
        s->X[0][i] = 0.013 + (i % NX + 0.5) * H;
        s->X[1][i] = -0.002 + (i / NX + 0.5) * H;
        if (i / NX == 20 && i % NX >= 10) s->state[i] = i % NX >= 30 ? FILM_CRACKED : FILM_DAMAGED;
    }
}

/* Returns the size in bytes of the shown frames of the animation: per group 4 bytes for the displacement in each frame,
 * and 4 once for the position plus at most 6 for size and two fields. */
static int64_t film_bytes(const struct run_animation *animation)
{
    return animation->set->groups * (4 * animation->used + 10);
}

static void groups_cover_the_body(void **state)
{
    struct run_animation f;
    (void)state;
    plate_make(&f);
    for (int levels = 0; levels <= FILM_LEVELS; levels++) {
        double area = 0, moment[2] = {0}, wanted[2] = {0};
        int64_t members = 0, busy = 0;
        f.levels = levels;
        animation_particle_set_merge_into_groups(f.set, &f);
        const struct animation_particle_set *s = f.set;
        for (int64_t g = 0; g < s->groups; g++) {
            const double size = animation_group_drawn_edge_length(s, &f, g);
            const int32_t n = s->first[g + 1] - s->first[g];
            members += n;
            area += size * size;
            for (int32_t k = s->first[g]; k < s->first[g + 1]; k++) {
                const bool damaged = s->state[s->member[k]] != FILM_INTACT;
                busy += damaged;
                if (damaged) assert_int_equal(n, 1);
                for (int d = 0; d < 2; d++) moment[d] += size * size * s->X[d][s->member[k]] / n;
            }
        }
        for (int i = 0; i < s->n; i++)
            for (int d = 0; d < 2; d++) wanted[d] += H * H * s->X[d][i];
        assert_int_equal(members, NX * NY);
        assert_int_equal(busy, NX - 10);
        /* sums of two thousand terms, each rounded to 1e-16 of the largest */
        assert_true(fabs(area / (H * H * NX * NY) - 1) < 1e-12);
        for (int d = 0; d < 2; d++) assert_true(fabs(moment[d] / wanted[d] - 1) < 1e-12);
        if (levels == 0) assert_int_equal(s->groups, NX * NY);
        /* 17 of 18 pairs of full rows merge to cells of 2 x 2 without a damaged particle; row 36 has no partner; rows
         * 20 and 21 are merged only from x = 0 to 10 H. */
        if (levels == 1) assert_int_equal(s->groups, 17 * 25 + 5 + 2 * 40 + NX);
    }
    animation_free(&f);
}

/* Checks that particles of different materials, fragment histories or bodies are never merged into one group. */
static void groups_do_not_mix(void **state)
{
    struct run_animation f;
    (void)state;
    plate_make(&f);
    struct animation_particle_set *s = f.set;
    f.levels = FILM_LEVELS;
    for (int i = 0; i < s->n; i++) {
        s->material[i] = i % NX >= 23;
        s->body[i] = i / NX >= 11;
        s->history[i] = (i % NX + i / NX) % 50 > 30;
    }
    animation_particle_set_merge_into_groups(s, &f);
    for (int64_t g = 0; g < s->groups; g++)
        for (int32_t k = s->first[g]; k < s->first[g + 1]; k++) {
            const int32_t i = s->member[k], j = s->member[s->first[g]];
            assert_int_equal(s->material[i], s->material[j]);
            assert_int_equal(s->body[i], s->body[j]);
            assert_int_equal(s->history[i], s->history[j]);
        }
    animation_free(&f);
}

/* Returns true if every particle of the plate `animation` is inside the cell that is drawn for its group. */
static bool covers_the_body(const struct run_animation *animation)
{
    const struct animation_particle_set *s = animation->set;
    for (int64_t g = 0; g < s->groups; g++)
        for (int32_t k = s->first[g]; k < s->first[g + 1]; k++)
            for (int d = 0; d < 2; d++)
                if (fabs(s->X[d][s->member[k]] - animation_group_centre_coordinate(s, animation, g, d)) + 0.49 * H >
                    animation_group_drawn_edge_length(s, animation, g) / 2)
                    return false;
    return s->first[s->groups] == NX * NY;
}

static void budgets_are_kept(void **state)
{
    (void)state;
    int64_t before = INT64_MAX;
    for (int64_t budget = 1 << 20; budget > 2000; budget /= 2) {
        struct run_animation f;
        plate_make(&f);
        animation_select_content_within_byte_budget(&f, budget);
        assert_true(film_bytes(&f) <= budget);
        assert_true(f.frame[0].used && f.frame[FRAMES - 1].used);
        assert_true(film_bytes(&f) <= before);
        before = film_bytes(&f);
        int used = 0;
        for (int k = 0; k < FRAMES; k++) used += f.frame[k].used;
        assert_int_equal(used, f.used);
        /* A limit above the whole size omits nothing; damaged particles are merged last. */
        if (budget == 1 << 20) assert_true(f.used == FRAMES && f.set->groups == NX * NY);
        int64_t cracked = 0;
        for (int64_t g = 0; g < f.set->groups; g++)
            cracked += f.set->first[g + 1] - f.set->first[g] == 1 &&
                       f.set->state[f.set->member[f.set->first[g]]] == FILM_CRACKED;
        if (f.levels_all == 0) assert_int_equal(cracked, NX - 30);
        assert_true(covers_the_body(&f));
        animation_free(&f);
    }
}

/* Checks that in magnified frames a rigid body has the displacement of the particle nearest to its current position.
 * The brick of 4 x 2 has rotated by a right angle and moved; the second particle is nearest to its current, the third
 * to its initial position. */
static void rigid_bodies_follow_the_nearest_particle(void **state)
{
    (void)state;
    static struct solid brick = {.kind = SOLID_BOX, .to = {4, 2}};
    static const struct region shape = {.n = 1, .solid = &brick};
    static const struct rigid_placement at = {{2, 1}, {8}, {{0, -1}, {1}, {0, 0, 1}}};
    real X[2][3] = {{0, 4, 2}, {0, -1, 0}}, moved[2];
    float u[2][3] = {{0, 0.5F, 0}, {0, -0.25F, 0.125F}};
    const struct output_frame f = {.n = 3, .dim = 2, .X = {X[0], X[1]}, .u = {u[0], u[1]}};
    rigid_body_displacement_of_nearest_particle(&shape, &at, &f, moved);
    assert_true(moved[0] == 0.5 && moved[1] == -0.25);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(groups_cover_the_body),
        cmocka_unit_test(groups_do_not_mix),
        cmocka_unit_test(budgets_are_kept),
        cmocka_unit_test(rigid_bodies_follow_the_nearest_particle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
