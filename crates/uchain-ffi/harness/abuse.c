/* Wrong use of the library: what an author gets wrong, and what the air brings. */

#include "abuse.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "uchain.h"

static int wrong;
static unsigned long tried;

static void expect(int holds, const char *what)
{
    tried++;
    if (!holds) {
        wrong++;
        fprintf(stderr, "not so: %s\n", what);
    }
}
#define EXPECT(claim) expect((claim), #claim)

static uchain_node node;
static uchain_params params;
static uchain_observation seen;
static uchain_command command;
static uchain_explanation why;
/* A packet with room before and behind it, which nobody may touch. */
static uint8_t room[10 + UCHAIN_PACKET_MAX + 10];
static uint8_t *const packet = room + 10;

/* The same numbers on every machine. */
static uint32_t drawn = 1;
static uint8_t draw(void)
{
    drawn = drawn * 1664525u + 1013904223u;
    return (uint8_t)(drawn >> 24);
}

static void fresh(void)
{
    memset(&seen, 0, sizeof seen);
    uchain_params_default(&params);
    EXPECT(uchain_node_init(&node, UCHAIN_ROLE_RELAY, 7, &params) == UCHAIN_STATUS_OK);
}

static int hovers(void)
{
    return command.forward_mps == 0.0f && command.lateral_mps == 0.0f && command.yaw_rate_radps == 0.0f;
}

static void pointers(void)
{
    const char *key = "";
    static uchain_node never;
    /* One byte behind where a node may lie. */
    uchain_node *askew = (uchain_node *)(void *)((uint8_t *)(void *)&never + 1);
    fresh();
    EXPECT(uchain_params_default(NULL) == UCHAIN_STATUS_BAD_POINTER);
    EXPECT(uchain_params_frontiers2021(NULL) == UCHAIN_STATUS_BAD_POINTER);
    EXPECT(uchain_params_cavemod(NULL) == UCHAIN_STATUS_BAD_POINTER);
    EXPECT(uchain_params_check(NULL, &key) == UCHAIN_STATUS_BAD_POINTER && key == NULL);
    EXPECT(uchain_params_check(&params, NULL) == UCHAIN_STATUS_OK);
    EXPECT(uchain_params_check(NULL, NULL) == UCHAIN_STATUS_BAD_POINTER);
    EXPECT(uchain_node_init(NULL, UCHAIN_ROLE_HEAD, 0, &params) == UCHAIN_STATUS_BAD_POINTER);
    EXPECT(uchain_node_init(&never, UCHAIN_ROLE_HEAD, 0, NULL) == UCHAIN_STATUS_BAD_POINTER);
    EXPECT(uchain_step(&node, &seen, NULL) == UCHAIN_STATUS_BAD_POINTER);
    EXPECT(uchain_step(&node, NULL, &command) == UCHAIN_STATUS_BAD_POINTER && hovers());
    EXPECT(uchain_step(NULL, &seen, &command) == UCHAIN_STATUS_BAD_POINTER && hovers());
    EXPECT(uchain_explain(NULL, &seen, &why) == UCHAIN_STATUS_BAD_POINTER);
    EXPECT(uchain_explain(&node, NULL, &why) == UCHAIN_STATUS_BAD_POINTER);
    EXPECT(uchain_explain(&node, &seen, NULL) == UCHAIN_STATUS_BAD_POINTER);
    EXPECT(uchain_hear(NULL, packet, 14, 50.0f) == UCHAIN_STATUS_BAD_POINTER);
    EXPECT(uchain_hear(&node, NULL, 14, 50.0f) == UCHAIN_STATUS_BAD_POINTER);
    EXPECT(uchain_say(NULL, &seen, packet) == 0);
    EXPECT(uchain_say(&node, NULL, packet) == 0);
    EXPECT(uchain_say(&node, &seen, NULL) == 0);
    EXPECT(uchain_say_base(0, NULL) == 0);
    /* Memory that no node was made in, and memory where none can lie. */
    command.forward_mps = 1.0f;
    EXPECT(uchain_step(&never, &seen, &command) == UCHAIN_STATUS_NOT_INITIALISED && hovers());
    EXPECT(command.airborne == 0);
    EXPECT(uchain_explain(&never, &seen, &why) == UCHAIN_STATUS_NOT_INITIALISED);
    EXPECT(uchain_hear(&never, packet, 14, 50.0f) == UCHAIN_STATUS_NOT_INITIALISED);
    EXPECT(uchain_say(&never, &seen, packet) == 0);
    EXPECT(uchain_step(askew, &seen, &command) == UCHAIN_STATUS_BAD_POINTER);
    EXPECT(uchain_node_init(askew, UCHAIN_ROLE_HEAD, 0, &params) == UCHAIN_STATUS_BAD_POINTER);
}

/* Every byte of a choice that is none of them. */
static void choices(void)
{
    static const size_t flags[] = {
        offsetof(uchain_observation, has_place),    offsetof(uchain_observation, has_tof),
        offsetof(uchain_observation, has_pilot),    offsetof(uchain_observation, is_decision_due),
        offsetof(uchain_observation, has_battery),  offsetof(uchain_observation, has_ground_speed),
    };
    static const struct { size_t field; int choices; const char *key; } keys[] = {
        { offsetof(uchain_params, equalize_law), 3, "equalize.law" },
        { offsetof(uchain_params, equalize_spacing), 2, "equalize.spacing" },
        { offsetof(uchain_params, center_law), 3, "center.law" },
        { offsetof(uchain_params, takeoff_launch), 2, "takeoff.launch" },
        { offsetof(uchain_params, takeoff_launch_signal), 2, "takeoff.launch_signal" },
        { offsetof(uchain_params, link_signal), 2, "link.signal" },
        { offsetof(uchain_params, link_gap), 2, "link.gap" },
        { offsetof(uchain_params, link_base_flow), 2, "link.base_flow" },
    };
    for (int byte = 0; byte < 256; byte++) {
        fresh();
        EXPECT((uchain_node_init(&node, (uint8_t)byte, 7, &params) == UCHAIN_STATUS_OK) == (byte < 2));
        for (size_t i = 0; i < sizeof flags / sizeof *flags; i++) {
            fresh();
            *((uint8_t *)&seen + flags[i]) = (uint8_t)byte;
            EXPECT((uchain_step(&node, &seen, &command) == UCHAIN_STATUS_OK) == (byte < 2));
            EXPECT((uchain_say(&node, &seen, packet) != 0) == (byte < 2));
        }
        fresh();
        seen.has_pilot = 1;
        seen.pilot_follow = (uint8_t)byte;
        EXPECT((uchain_step(&node, &seen, &command) == UCHAIN_STATUS_OK) == (byte < 3));
        for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
            const char *key = NULL;
            uchain_status status;
            fresh();
            *((uint8_t *)&params + keys[i].field) = (uint8_t)byte;
            status = uchain_params_check(&params, &key);
            EXPECT((status == UCHAIN_STATUS_OK) == (byte < keys[i].choices));
            EXPECT(status == UCHAIN_STATUS_OK ? key == NULL : strcmp(key, keys[i].key) == 0);
            EXPECT(uchain_node_init(&node, UCHAIN_ROLE_RELAY, 7, &params) == status);
        }
    }
    EXPECT(uchain_node_init(&node, UCHAIN_ROLE_RELAY, UCHAIN_BASE_ID, &params) != UCHAIN_STATUS_OK);
    /* Who has taken off is not told to land by a byte that is wrong. */
    fresh();
    EXPECT(uchain_node_init(&node, UCHAIN_ROLE_HEAD, 7, &params) == UCHAIN_STATUS_OK);
    seen.is_decision_due = 1;
    EXPECT(uchain_step(&node, &seen, &command) == UCHAIN_STATUS_OK && command.airborne == 1);
    seen.has_tof = 2;
    EXPECT(uchain_step(&node, &seen, &command) == UCHAIN_STATUS_BAD_CHOICE);
    EXPECT(command.airborne == 1 && hovers());
}

static const float EXTREMES[] = { NAN, INFINITY, -INFINITY, 3.4e38f, -3.4e38f, 1e-45f, -0.0f, 0.0f };
enum { EXTREME = sizeof EXTREMES / sizeof *EXTREMES };

/* Every number of the params at every extreme: refused and named, or flown. */
static void tunables(void)
{
    static const uint8_t byte_fields[] = {
        offsetof(uchain_params, equalize_law),   offsetof(uchain_params, equalize_spacing),
        offsetof(uchain_params, center_law),     offsetof(uchain_params, takeoff_launch),
        offsetof(uchain_params, takeoff_launch_signal), offsetof(uchain_params, link_signal),
        offsetof(uchain_params, link_base_flow),
    };
    for (size_t field = 0; field < sizeof params; field += sizeof(float)) {
        if (memchr(byte_fields, (int)field, sizeof byte_fields) != NULL) {
            continue;
        }
        for (int i = 0; i < EXTREME; i++) {
            const char *key = NULL;
            uchain_status status;
            fresh();
            memcpy((uint8_t *)&params + field, &EXTREMES[i], sizeof(float));
            status = uchain_params_check(&params, &key);
            EXPECT(i > 4 || status == UCHAIN_STATUS_OUT_OF_RANGE);
            EXPECT((status == UCHAIN_STATUS_OK) == (key == NULL));
            EXPECT(key == NULL || (strchr(key, '.') != NULL && strlen(key) < 40));
            EXPECT(uchain_node_init(&node, UCHAIN_ROLE_RELAY, 7, &params) == status);
        }
    }
}

/* Readings that are none: the node goes on, and what it asks for stays within its limits. */
static void readings(void)
{
    fresh();
    for (int turn = 0; turn < 4000; turn++) {
        float *fields[] = { &seen.tof_nw_m, &seen.tof_ne_m, &seen.tof_sw_m, &seen.tof_se_m,
                            &seen.ground_speed_mps, &seen.battery, &seen.pilot_speed_mps };
        for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
            *fields[i] = EXTREMES[draw() % EXTREME];
        }
        seen.has_tof = seen.has_ground_speed = seen.has_battery = seen.has_pilot = seen.has_place = 1;
        seen.is_decision_due = draw() & 1;
        seen.place = (uint16_t)(draw() & 3 ? draw() % 5 : 65533);
        if (uchain_say_base(draw(), packet) != 0) {
            uchain_status status = uchain_hear(&node, packet, 14, EXTREMES[draw() % EXTREME]);
            EXPECT(status == UCHAIN_STATUS_OK || status == UCHAIN_STATUS_OUT_OF_RANGE);
        }
        EXPECT(uchain_say(&node, &seen, packet) == 14);
        EXPECT(uchain_step(&node, &seen, &command) == UCHAIN_STATUS_OK);
        EXPECT(fabsf(command.forward_mps) <= params.equalize_v_max_mps);
        EXPECT(fabsf(command.lateral_mps) <= params.center_lateral_max_mps);
        EXPECT(fabsf(command.yaw_rate_radps) <= params.center_yaw_rate_max_radps);
        EXPECT(command.airborne <= 1);
        EXPECT(uchain_explain(&node, &seen, &why) == UCHAIN_STATUS_OK);
    }
}

/* Whatever the air brings. */
static void packets(void)
{
    fresh();
    for (uint32_t length = 0; length < 40; length++) {
        memset(room, 1, sizeof room);
        uchain_status status = uchain_hear(&node, packet, length, 50.0f);
        EXPECT(length >= 14 || status == UCHAIN_STATUS_TOO_SHORT);
        EXPECT(length <= UCHAIN_PACKET_MAX || status == UCHAIN_STATUS_TOO_LONG);
    }
    EXPECT(uchain_hear(&node, packet, UINT32_MAX, 50.0f) == UCHAIN_STATUS_TOO_LONG);
    for (int turn = 0; turn < 20000; turn++) {
        for (size_t i = 0; i < UCHAIN_PACKET_MAX; i++) {
            packet[i] = draw();
        }
        /* Half of them look right at first. */
        if (turn % 2 == 0) {
            packet[0] = 1;
            packet[1] &= 7;
        }
        uchain_status status = uchain_hear(&node, packet, draw() % 31, 50.0f);
        EXPECT(status <= UCHAIN_STATUS_OWN_ID && status != UCHAIN_STATUS_NOT_INITIALISED);
        seen.is_decision_due = turn % 64 == 0;
        EXPECT(uchain_step(&node, &seen, &command) == UCHAIN_STATUS_OK);
        EXPECT(fabsf(command.forward_mps) <= params.equalize_v_max_mps);
    }
    /* The version comes first, and nobody is his own neighbour. */
    fresh();
    EXPECT(uchain_say(&node, &seen, packet) == 14);
    EXPECT(uchain_hear(&node, packet, 14, 50.0f) == UCHAIN_STATUS_OWN_ID);
    packet[0] = 99;
    EXPECT(uchain_hear(&node, packet, 14, 50.0f) == UCHAIN_STATUS_OTHER_VERSION);
    EXPECT(uchain_say_base(0, packet) == 14);
    packet[1] |= 3;
    EXPECT(uchain_hear(&node, packet, 14, 50.0f) == UCHAIN_STATUS_MALFORMED);
    EXPECT(uchain_hear(&node, packet, 14, NAN) == UCHAIN_STATUS_MALFORMED);
    /* Nobody writes beside the packet. */
    memset(room, 0xa5, sizeof room);
    EXPECT(uchain_say(&node, &seen, packet) == 14);
    for (size_t i = 0; i < 10; i++) {
        EXPECT(room[i] == 0xa5 && room[10 + UCHAIN_PACKET_MAX + i] == 0xa5);
    }
}

/* More senders than there is room for: neighbours are kept, and the newest packet of each. */
static void crowd(void)
{
    uchain_node other;
    fresh();
    for (uint16_t sender = 0; sender < 40; sender++) {
        uchain_observation theirs;
        memset(&theirs, 0, sizeof theirs);
        theirs.has_place = 1;
        theirs.place = (uint16_t)(sender < 20 ? sender : 59 - sender);
        EXPECT(uchain_node_init(&other, UCHAIN_ROLE_RELAY, (uint16_t)(100 + sender), &params) == UCHAIN_STATUS_OK);
        EXPECT(uchain_say(&other, &theirs, packet) == 14);
        EXPECT(uchain_hear(&node, packet, 14, 90.0f) == UCHAIN_STATUS_OK);
        EXPECT(uchain_hear(&node, packet, 14, 40.0f + (float)theirs.place) == UCHAIN_STATUS_OK);
    }
    /* A relay that was told no place is the last: its neighbour is the one at place 39. */
    seen.is_decision_due = 1;
    EXPECT(uchain_step(&node, &seen, &command) == UCHAIN_STATUS_OK);
    EXPECT(uchain_explain(&node, &seen, &why) == UCHAIN_STATUS_OK);
    EXPECT(why.front_raw_db == 79.0f);
}

/* A packet of one that believes to be at this place. */
static void say_from(uint16_t id, uint16_t place, float loss_db)
{
    static uchain_node other;
    uchain_observation theirs;
    memset(&theirs, 0, sizeof theirs);
    theirs.has_place = 1;
    theirs.place = place;
    EXPECT(uchain_node_init(&other, UCHAIN_ROLE_RELAY, id, &params) == UCHAIN_STATUS_OK);
    EXPECT(uchain_say(&other, &theirs, packet) == 14);
    EXPECT(uchain_hear(&node, packet, 14, loss_db) == UCHAIN_STATUS_OK);
}

/* Eight senders that all claim one place leave room for the neighbour. */
static void crowd_at_one_place(void)
{
    fresh();
    seen.has_place = 1;
    seen.place = 5;
    EXPECT(uchain_step(&node, &seen, &command) == UCHAIN_STATUS_OK);
    for (uint16_t sender = 0; sender < 8; sender++) {
        say_from((uint16_t)(200 + sender), 3, 90.0f);
    }
    say_from(300, 4, 55.0f);
    say_from(301, 6, 56.0f);
    say_from(302, 2, 95.0f);
    seen.is_decision_due = 1;
    EXPECT(uchain_step(&node, &seen, &command) == UCHAIN_STATUS_OK);
    EXPECT(uchain_explain(&node, &seen, &why) == UCHAIN_STATUS_OK);
    EXPECT(why.front_raw_db == 55.0f);
    /* No UAV has the base's place, or that of a relay that was told none. */
    for (uint32_t place = 65534; place <= 65535; place++) {
        seen.place = (uint16_t)place;
        EXPECT(uchain_step(&node, &seen, &command) == UCHAIN_STATUS_OUT_OF_RANGE);
    }
}

int abuse(void)
{
    pointers();
    choices();
    tunables();
    readings();
    packets();
    crowd();
    crowd_at_one_place();
    printf("%lu claims about wrong use, %d of them not so\n", tried, wrong);
    return wrong == 0 ? 0 : 1;
}
