/* Tests of crack tips, which are found from the damage of particles; the damage is set by hand. */
#include "fracture/places.h"
#include "tests/support/bodies.h"

/* Checks where crack tips are created at pre-cracks: at ends inside the body that no other pre-crack continues, with
 * more than one free particle ahead. */
static void tip_starts_only_where_the_body_goes_on(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    notched_make(&b, &t, 4);
    assert_int_equal(t.n, 1);
    assert_true(t.tip[0].from_crack);
    assert_near(t.tip[0].origin[0], 10, 0);
    assert_near(t.tip[0].along[0], 1, 0);
    assert_near(t.tip[0].along[1], 0, 0);
    assert_int_equal(t.label[particle_at(&b, 3.5, 10.5, 0)], 255);
    assert_null(tips_find_tip_with_largest_growth(&t));
    assert_true(isnan(tip_deflection_angle(&t.tip[0], 2)));
    tips_free(&t);

    /* Both ends inside: two tips; a second segment that continues the first removes their common end. */
    real first[2][DIM_MAX] = {{10, 10, 0}, {20, 10, 0}}, second[2][DIM_MAX] = {{20, 10, 0}, {25, 15, 0}};
    struct crack crack[2] = {{.n = 2, .corner = first}, {.n = 2, .corner = second}};
    tips_make_at_precrack_ends(&t, &b.p, &b.c, crack, 1, 1, 4);
    assert_int_equal(t.n, 2);
    assert_near(t.tip[0].along[0], -1, 0);
    tips_free(&t);
    tips_make_at_precrack_ends(&t, &b.p, &b.c, crack, 2, 1, 4);
    assert_int_equal(t.n, 2);
    assert_near(t.tip[1].origin[0], 25, 0);
    assert_near(t.tip[1].along[1], sqrt(0.5), 1e-15);
    tips_free(&t);

    /* No tip if only a single particle is ahead of it. */
    real out[2][DIM_MAX] = {{30, 19.9, 0}, {39.2, 19.9, 0}};
    struct crack outward = {.n = 2, .corner = out};
    tips_make_at_precrack_ends(&t, &b.p, &b.c, &outward, 1, 1, 4);
    assert_int_equal(t.n, 1);
    assert_near(t.tip[0].along[0], -1, 0);
    tips_free(&t);

    /* Fixed particles cannot crack: no tip in front of them. */
    for (int64_t i = 0; i < b.p.n; i++)
        if (b.p.X[0][i] < 10) b.p.flag[i] |= FLAG_DRIVEN;
    tips_make_at_precrack_ends(&t, &b.p, &b.c, crack, 1, 1, 4);
    assert_int_equal(t.n, 1);
    assert_near(t.tip[0].along[0], 1, 0);
    notched_free(&b, &t);
}

/* Checks the tip speed of a crack that grows by one particle per sample for ten samples of 1/500 s and then rests: 500
 * m/s from the second sample on. Tolerance: round-off times 500/(1/500 s). */
static void tip_speed_is_the_slope_of_growth(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    real dt = 1.0 / 500;
    notched_make(&b, &t, 4 * dt);
    for (int k = 0; k <= 16; k++) {
        if (k >= 1 && k <= 10) hurt(&b, 9.5 + k, 10.5, 0);
        tips_update_from_damage(&t, &b.p, &b.c, k * dt);
        assert_true(isnan(t.tip[0].arrest_time) == (k < 2));
    }
    const struct crack_tip *tip = tips_find_tip_with_largest_growth(&t);
    assert_ptr_equal(tip, &t.tip[0]);
    assert_int_equal(t.n, 1);
    assert_int_equal(tip->particles, 10);
    assert_near(tip->growth, 9.5, ROUND_OFF);
    assert_near(tip->place[0], 19.5, ROUND_OFF);
    assert_near(tip->first_time, dt, 1e-15);
    assert_near(tip->start_time, 2 * dt, 1e-15);
    assert_near(tip->arrest_time, 10 * dt, 1e-15);
    assert_near(tip->speed_max, 500, 1e-9); /* slopes of exact lines: round-off times 500/dt */
    assert_near(tip->speed_mean, 500, 1e-9);
    assert_near(tip_deflection_angle(tip, 2), 0, 1e-5); /* acos near 1 halves the digits */
    notched_free(&b, &t);
}

/* Checks tip speeds if growth varies: the largest speed is that of the steepest time window, and the mean speed is
 * between slow and fast growth. Slow growth is one particle every second sample. */
static void tip_speed_takes_the_steepest_window(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    notched_make(&b, &t, 4);
    int reached = 0;
    for (int k = 0; k <= 20; k++) {
        int wanted = k <= 12 ? k / 2 : 6 + (k - 12);
        for (; reached < wanted; reached++) hurt(&b, 10.5 + reached, 10.5, 0);
        tips_update_from_damage(&t, &b.p, &b.c, k);
    }
    assert_near(t.tip[0].speed_max, 1, 1e-12);
    assert_true(t.tip[0].speed_mean > 0.6 && t.tip[0].speed_mean < 0.8);
    notched_free(&b, &t);
}

static void tip_turns(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    notched_make(&b, &t, 4);
    hurt(&b, 10.5, 11.5, 0), hurt(&b, 11.5, 12.5, 0), hurt(&b, 12.5, 13.5, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 0);
    assert_int_equal(t.n, 1);
    assert_near(tip_deflection_angle(&t.tip[0], 2), atan2(3, 2.5) * 180 / M_PI, 1e-10);
    /* A mirror image about y = 10.5: the tip is on the upper of both branches; then on the longer one. */
    assert_int_equal(tips_count_crack_ends_with_largest_growth(&t), 1);
    hurt(&b, 10.5, 9.5, 0), hurt(&b, 11.5, 8.5, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 1);
    assert_int_equal(tips_count_crack_ends_with_largest_growth(&t), 1); /* 3.9 and 2.5 */
    hurt(&b, 12.5, 7.5, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 2);
    assert_int_equal(t.tip[0].particles, 6);
    assert_near(t.tip[0].growth, hypot(2.5, 3), ROUND_OFF);
    assert_near(t.tip[0].place[0], 12.5, ROUND_OFF);
    assert_near(t.tip[0].place[1], 13.5, ROUND_OFF);
    assert_int_equal(tips_count_crack_ends_with_largest_growth(&t), 2);
    hurt(&b, 13.5, 6.5, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 3);
    assert_near(t.tip[0].place[1], 6.5, ROUND_OFF);
    assert_int_equal(tips_count_crack_ends_with_largest_growth(&t), 1); /* 5.3 and 3.9 */
    notched_free(&b, &t);
}

/* Checks the number of crack ends with the largest growth. Two rows of damaged particles beside a straight crack are
 * one end, positioned between them; two branches that start there are two ends, and so are the tips at both ends of a
 * crack. */
static void tips_that_tie(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    real X[2][DIM_MAX] = {{15, 10, 0}, {25, 10, 0}};
    struct crack crack = {.n = 2, .corner = X};
    notched_make(&b, &t, 4);
    tips_free(&t);
    tips_make_at_precrack_ends(&t, &b.p, &b.c, &crack, 1, 1, 4);
    assert_int_equal(t.n, 2);
    assert_int_equal(tips_count_crack_ends_with_largest_growth(&t), 0);
    for (int k = 0; k < 4; k++)
        for (int side = -1; side <= 1; side += 2)
            hurt(&b, 25.5 + k, 10 + 0.5 * side, 0), hurt(&b, 14.5 - k, 10 + 0.5 * side, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 0);
    for (int k = 0; k < 2; k++) assert_near(t.tip[k].place[1], 10, ROUND_OFF);
    assert_near(fabs(t.tip[0].place[0] - 20), 8.5, ROUND_OFF);
    assert_int_equal(tips_count_crack_ends_with_largest_growth(&t), 2);
    assert_ptr_equal(tips_find_tip_with_largest_growth(&t), &t.tip[0]);
    for (int k = 1; k < 4; k++)
        for (int side = -1; side <= 1; side += 2) hurt(&b, 28.5 + k, 10 + (0.5 + k) * side, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 1);
    const struct crack_tip *longest = tips_find_tip_with_largest_growth(&t);
    assert_near(longest->place[0], 31.5, ROUND_OFF);
    assert_near(longest->place[1], 13.5, ROUND_OFF); /* a damaged position, not (31.5, 10) */
    assert_int_equal(tips_count_crack_ends_with_largest_growth(&t), 2);
    notched_free(&b, &t);
}

/* Checks the representative position of groups of near positions: their mean, or the position nearest to it if the mean
 * is not near one of them; of several groups that with the largest x. */
static void places_of_groups(void **state)
{
    (void)state;
    const real none[DIM_MAX] = {0}, along[DIM_MAX] = {0, 0, 1};
    struct place place[48];
    real middle[DIM_MAX];
    for (int k = 0; k < 24; k++) {
        const real angle = k * M_PI / 12;
        place[k] = (struct place){{7 + 5 * cos(angle), 3 + 5 * sin(angle)}, false};
        place[24 + k] = (struct place){{-7 + cos(angle), 3, 0.37 * k}, k < 12};
    }
    assert_int_equal(position_clusters_count_and_centre_at_largest_x(place, 24, 2, 1.5, none, middle), 1);
    assert_near(hypot(middle[0] - 7, middle[1] - 3), 5, ROUND_OFF);
    assert_int_equal(position_clusters_count_and_centre_at_largest_x(place, 24, 2, 1.2, none, middle),
                     24); /* their distance is 1.305 */
    assert_near(middle[0], 12, ROUND_OFF);
    assert_near(middle[1], 3, ROUND_OFF);
    assert_int_equal(position_clusters_count_and_centre_at_largest_x(place, 48, 3, 1.5, none, middle), 2);
    assert_true(middle[0] > 1);
    assert_int_equal(position_clusters_count_and_centre_at_largest_x(place + 24, 24, 3, 4.5, along, middle),
                     1); /* the mean of the twelve that count */
    assert_near(middle[2], 0.37 * 17.5, ROUND_OFF);
    assert_int_equal(position_clusters_count_and_centre_at_largest_x(place + 24, 12, 3, 4.5, along, middle), 0);
    assert_int_equal(position_clusters_count_and_centre_at_largest_x(place, 0, 2, 1.5, none, middle), 0);
}

/* Checks which damage is not growth: that of the faces of the pre-crack beside its end, of fixed particles, and of
 * other bodies. */
static void tip_growth_leaves_out(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    notched_make(&b, &t, 4);
    hurt(&b, 9.5, 11.5, 0);
    hurt(&b, 30.5, 2.5, 0);
    b.p.flag[particle_at(&b, 30.5, 2.5, 0)] |= FLAG_DRIVEN;
    tips_update_from_damage(&t, &b.p, &b.c, 0);
    assert_int_equal(t.n, 1);
    assert_int_equal(t.tip[0].particles, 1);
    assert_near(t.tip[0].growth, 0, 0);
    assert_true(isnan(t.tip[0].start_time));
    assert_near(t.tip[0].first_time, 0, 0);

    hurt(&b, 10.5, 10.5, 0), hurt(&b, 11.5, 10.5, 0);
    b.p.body[particle_at(&b, 11.5, 10.5, 0)] = 1;
    tips_update_from_damage(&t, &b.p, &b.c, 1);
    assert_int_equal(t.n, 2);
    assert_near(t.tip[0].growth, 0.5, ROUND_OFF);
    assert_int_equal(t.tip[1].body, 1);
    assert_false(t.tip[1].from_crack);
    notched_free(&b, &t);
}

/* Checks that a crack that starts separately is joined by the crack that reaches it, and that this jump increases the
 * length of the crack but not its speed. */
static void tip_joins_a_crack_ahead(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    notched_make(&b, &t, 3);
    for (int k = 0; k <= 5; k++) {
        if (k > 0) hurt(&b, 9.5 + k, 10.5, 0);
        for (int m = 0; k == 3 && m < 4; m++) hurt(&b, 16.5 + m, 10.5, 0);
        if (k > 3) hurt(&b, 30.5, 0.5 + k, 0);
        tips_update_from_damage(&t, &b.p, &b.c, k);
    }
    assert_int_equal(t.n, 3);
    assert_near(t.tip[1].growth, 3, ROUND_OFF);
    assert_near(t.tip[0].growth, 4.5, ROUND_OFF);
    real origin = t.tip[1].origin[0];
    assert_near(origin, 16.5, 0); /* equal damage: the lowest index */
    hurt(&b, 15.5, 10.5, 0);
    hurt(&b, 30.5, 6.5, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 6);
    assert_int_equal(t.n, 2);
    assert_int_equal(t.tip[0].particles, 10);
    assert_near(t.tip[0].growth, 9.5, ROUND_OFF);
    assert_near(t.tip[0].speed_max, 1, 1e-12);
    for (int64_t i = 0; i < b.p.n; i++) assert_true(t.label[i] <= 2 || t.label[i] == 255);

    /* The third crack, growing by one particle per second, keeps its history under its new index. */
    hurt(&b, 30.5, 7.5, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 7);
    assert_near(t.tip[1].growth, 3, ROUND_OFF);
    assert_near(t.tip[1].speed_max, 1, 1e-12);
    notched_free(&b, &t);
}

/* Checks that two cracks that start beside one another and have grown in the same direction remain two, each with its
 * own start, when damage connects their starts; and that a third crack that reaches this damage joins both. */
static void tips_that_touch_beside_are_two(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    notched_make(&b, &t, 3);
    hurt(&b, 20.5, 8.5, 0), hurt(&b, 20.5, 12.5, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 0);
    for (int k = 1; k <= 6; k++) {
        hurt(&b, 20.5 + k, 8.5, 0), hurt(&b, 20.5 + k, 12.5, 0);
        tips_update_from_damage(&t, &b.p, &b.c, k);
    }
    hurt(&b, 20.5, 9.5, 0), hurt(&b, 20.5, 10.5, 0), hurt(&b, 20.5, 11.5, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 7);
    assert_int_equal(t.n, 3);
    for (int k = 1; k < 3; k++) {
        assert_int_equal(t.tip[k].number, k + 1);
        assert_near(t.tip[k].growth, 6, ROUND_OFF);
        assert_near(t.tip[k].place[1], t.tip[k].origin[1], 0);
    }

    /* The crack of the pre-crack reaches the damage that connects the two, and joins both. */
    for (int k = 1; k <= 10; k++) hurt(&b, 9.5 + k, 10.5, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 8);
    assert_int_equal(t.n, 2);
    assert_true(t.tip[0].number > 3);
    notched_free(&b, &t);
}

/* Checks that a crack of 16 spacings keeps its length when another crack, that of a pre-crack, reaches its middle.
 * Measured from the end of the pre-crack it would be 9 spacings long. */
static void tips_that_meet_do_not_heal(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    notched_make(&b, &t, 3);
    for (int k = 0; k <= 16; k++) hurt(&b, 14.5, 2.5 + k, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 0);
    assert_near(tips_find_tip_with_largest_growth(&t)->growth, 16, ROUND_OFF);
    for (int k = 0; k < 4; k++) {
        hurt(&b, 10.5 + k, 10.5, 0);
        tips_update_from_damage(&t, &b.p, &b.c, k + 1);
        assert_near(tips_find_tip_with_largest_growth(&t)->growth, 16, ROUND_OFF);
    }
    assert_int_equal(t.n, 2);
    notched_free(&b, &t);
}

/* Checks that a crack that only joins others after its first increment has no mean speed. */
static void tip_that_only_joins(void **state)
{
    (void)state;
    for (int wait = 1; wait < 9; wait++) {
        struct body b;
        struct crack_tips t;
        notched_make(&b, &t, 3);
        for (int k = 0; k <= wait + 1; k++) {
            if (k == 0) hurt(&b, 10.5, 10.5, 0), hurt(&b, 11.5, 10.5, 0);
            for (int m = 0; k == 0 && m < 4; m++) hurt(&b, 13.5 + m, 10.5, 0);
            if (k == wait + 1) hurt(&b, 12.5, 10.5, 0);
            tips_update_from_damage(&t, &b.p, &b.c, 0.1 * (k + 1));
        }
        assert_near(t.tip[0].growth, 6.5, ROUND_OFF);
        if (!isnan(t.tip[0].speed_mean)) fail_msg("%g, %d", t.tip[0].speed_mean, wait);
        notched_free(&b, &t);
    }
}

/* Checks that in 3D the whole edge of a crack inside the body is one tip (front), wherever along it the crack grows. */
static void tip_of_a_front(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    body_make(&b, 3, (const int[]){12, 6, 6});
    real corner[4][DIM_MAX] = {{-1, 3, -20}, {5, 3, -20}, {5, 3, 8}, {-1, 3, 8}};
    struct crack crack = {.n = 4, .corner = corner};
    tips_make_at_precrack_ends(&t, &b.p, &b.c, &crack, 1, 1, 4);
    assert_int_equal(t.n, 1);
    assert_near(t.tip[0].along[0], 1, 1e-15);
    assert_near(t.tip[0].origin[0], 5, 1e-12);
    assert_true(t.tip[0].origin[2] > 1 && t.tip[0].origin[2] < 5);
    for (real x = 5.5; x < 9; x++) hurt(&b, x, 3.5, 0.5);
    tips_update_from_damage(&t, &b.p, &b.c, 0);
    assert_int_equal(t.n, 1);
    assert_near(t.tip[0].growth, hypot(3.5, 0.5), 1e-12);
    assert_near(tip_deflection_angle(&t.tip[0], 3), atan2(0.5, 3.5) * 180 / M_PI, 1e-9);
    notched_free(&b, &t);
}

/* Checks the crack area in 2D: both faces of five spacings from a pre-crack; an oblique path; a separate crack. In a
 * plane of symmetry half of the area belongs to the body. */
static void tips_area_in_the_plane(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    const struct mirror_plane along = {.axis = 1, .outside = -1, .at = 10.5}, across = {.axis = 0, .at = 10};
    const struct tip_surroundings around = {NULL, 0, 2, 0.2}, on = {&along, 1, 2, 0.2}, beside = {&across, 1, 2, 0.2};
    notched_make(&b, &t, 4);
    tips_update_from_damage(&t, &b.p, &b.c, 0);
    assert_near(tips_total_crack_area(&t, &b.p, &around).face, 0, 0);
    for (real x = 10.5; x < 15; x++) hurt(&b, x, 10.5, 0), hurt(&b, x, 9.5, 0), hurt(&b, x, 11.5, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 1);
    assert_near(tips_total_crack_area(&t, &b.p, &around).face, 2 * 5, ROUND_OFF);
    assert_near(tips_total_crack_area(&t, &b.p, &on).own, 5, ROUND_OFF);
    assert_near(tips_total_crack_area(&t, &b.p, &on).face, 2 * 5, ROUND_OFF);
    assert_near(tips_total_crack_area(&t, &b.p, &beside).own, 2 * 5, ROUND_OFF);
    hurt(&b, 15.5, 12.5, 0), hurt(&b, 16.5, 13.5, 0);
    for (real x = 30.5; x < 33; x++) hurt(&b, x, 4.5, 0), hurt(&b, x, 3.5, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 2);
    assert_int_equal(t.n, 2);
    assert_near(tips_total_crack_area(&t, &b.p, &around).face, 2 * (ceil(hypot(6.5, 3)) + 3), ROUND_OFF);
    notched_free(&b, &t);
}

/* Checks the crack area of a front in 3D that has grown by 3 spacings on one half of its width and by one on the
 * other. */
static void tips_area_of_a_front(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    body_make(&b, 3, (const int[]){12, 6, 6});
    real corner[4][DIM_MAX] = {{-1, 3, -20}, {5, 3, -20}, {5, 3, 20}, {-1, 3, 20}};
    struct crack crack = {.n = 4, .corner = corner};
    tips_make_at_precrack_ends(&t, &b.p, &b.c, &crack, 1, 1, 4);
    assert_int_equal(t.n, 1);
    assert_near(2 * t.tip[0].edge[2], 6, 1); /* ends are located in steps of a spacing */
    for (real z = 0.5; z < 6; z++)
        for (real x = 5.5; x < (z < 3 ? 8 : 6); x++) hurt(&b, x, 3.5, z), hurt(&b, x, 2.5, z);
    tips_update_from_damage(&t, &b.p, &b.c, 0);
    const real strip = 2 * fabs(t.tip[0].edge[2]) / 6;
    assert_near(tips_total_crack_area(&t, &b.p, &(struct tip_surroundings){NULL, 0, 1, 0.2}).own,
                (3 * 3 + 3 * 1) * strip, ROUND_OFF);
    notched_free(&b, &t);
}

static void tips_never_outgrow_their_list(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    body_make(&b, 2, (const int[]){40, 20});
    tips_make_at_precrack_ends(&t, &b.p, &b.c, NULL, 0, 1, 4);
    for (int i = 0; i < 13; i++)
        for (int j = 0; j < 6; j++) hurt(&b, 0.5 + 3 * i, 0.5 + 3 * j, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 0);
    assert_int_equal(t.n, TIPS_MAX);
    int64_t members = 0;
    for (int k = 0; k < t.n; k++) members += t.tip[k].particles;
    assert_int_equal(members, 13 * 6);
    notched_free(&b, &t);
}

static void tips_survive_a_restart(void **state)
{
    (void)state;
    struct body b, fresh;
    struct crack_tips t, again;
    struct store s = {0};
    struct archive a = {.saving = true, .exchange = store_exchange, .file = &s};
    notched_make(&b, &t, 3);
    for (int k = 0; k < 6; k++) {
        hurt(&b, 10.5 + k, 10.5, 0);
        tips_update_from_damage(&t, &b.p, &b.c, k);
    }
    assert_ok(tips_save_or_load(&t, &a));
    a.saving = false;
    notched_make(&fresh, &again, 3);
    assert_ok(tips_save_or_load(&again, &a));
    for (int k = 6; k < 12; k++) {
        hurt(&b, 10.5 + k, 10.5, 0);
        tips_update_from_damage(&t, &b.p, &b.c, k);
        tips_update_from_damage(&again, &b.p, &b.c, k);
    }
    assert_int_equal(again.samples, 12);
    assert_memory_equal(&t.tip[0], &again.tip[0], sizeof t.tip[0]);
    assert_memory_equal(t.label, again.label, (size_t)t.count);
    store_free(&s);
    notched_free(&fresh, &again);
    notched_free(&b, &t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tip_starts_only_where_the_body_goes_on),
        cmocka_unit_test(tip_speed_is_the_slope_of_growth),
        cmocka_unit_test(tip_speed_takes_the_steepest_window),
        cmocka_unit_test(tip_turns),
        cmocka_unit_test(tips_that_tie),
        cmocka_unit_test(places_of_groups),
        cmocka_unit_test(tip_growth_leaves_out),
        cmocka_unit_test(tip_joins_a_crack_ahead),
        cmocka_unit_test(tips_that_touch_beside_are_two),
        cmocka_unit_test(tips_that_meet_do_not_heal),
        cmocka_unit_test(tip_that_only_joins),
        cmocka_unit_test(tip_of_a_front),
        cmocka_unit_test(tips_area_in_the_plane),
        cmocka_unit_test(tips_area_of_a_front),
        cmocka_unit_test(tips_never_outgrow_their_list),
        cmocka_unit_test(tips_survive_a_restart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
