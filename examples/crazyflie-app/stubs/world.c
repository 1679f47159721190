/* What stands in for the drone, the tunnel and the radio, so that the app can be flown without them: a straight tunnel 1 m
 * wide, a base at 0 m, a head that hovers 9 m deep, 5 dB a metre. The app flies between them.
 *
 *   crazyflie          flies for 70 s, lands, and looks whether it did what it should: 0 if so
 *   crazyflie deaf     the same with a dead radio, as a control: it may not take off
 *
 * On a chip it also tells how deep the app goes into its stack. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "commander.h"
#include "configblock.h"
#include "log.h"
#include "param.h"
#include "radiolink.h"
#include "task.h"

#include "uchain.h"

#define ROOT 1.41421356f
#define HEAD_M 9.0f
#define LAND_AT_MS 70000u
#define END_AT_MS 75000u

static bool is_deaf;
static TickType_t now_ms;
static P2PCallback callback;
static setpoint_t asked;
static uchain_node head;

/* Where the drone is: along the tunnel, to the left of its middle, above the ground (m); its speeds (m/s). */
static float at_m = 0.5f, left_m = 0.1f, height_m, along_mps, left_mps;
static float launched_s, said, deepest_m, levelled_m;

/* The operator's parameters and the app's variables. */
extern const struct stub_param stub_param_uchain[];
extern const struct stub_log stub_log_uchain[];

static void set(const char *name, uint8_t value)
{
    for (const struct stub_param *param = stub_param_uchain; param->name != NULL; param++) {
        if (strcmp(param->name, name) == 0) {
            *(uint8_t *)param->address = value;
        }
    }
}

static float variable(const char *name)
{
    for (const struct stub_log *one = stub_log_uchain; one->name != NULL; one++) {
        if (strcmp(one->name, name) == 0) {
            return *(const float *)one->address;
        }
    }
    return NAN;
}

#ifdef ON_CHIP
/* The app's stack: what is free below is painted at the end of every wait, and looked at when the next one begins. */
enum { WORDS = 1024 };
#define PAINT 0xdeadbeefu
static uint32_t *task_top, *lowest;

static uint32_t *stack_pointer(void)
{
    uint32_t *at;
    __asm__ volatile("mov %0, sp" : "=r"(at));
    return at;
}

static __attribute__((noinline)) void paint(void)
{
    for (uint32_t *at = task_top - WORDS; at < stack_pointer(); at++) {
        *(volatile uint32_t *)at = PAINT;
    }
}

static __attribute__((noinline)) void look(void)
{
    uint32_t *at = task_top - WORDS;
    while (at < task_top && *(volatile uint32_t *)at == PAINT) {
        at++;
    }
    if (lowest == NULL || at < lowest) {
        lowest = at;
    }
}
#else
#define paint() ((void)0)
#define look() ((void)0)
#endif

static int expect(int holds, const char *claim)
{
    if (!holds) {
        printf("not so: %s\n", claim);
    }
    return holds ? 0 : 1;
}

static void end(void)
{
    int wrong = 0;
    wrong += expect(launched_s > 1.0f && launched_s < 5.0f, "it takes off within 5 s");
    wrong += expect(fabsf(levelled_m - HEAD_M / 2.0f) < 0.3f, "it levels its two links, in the middle");
    wrong += expect(fabsf(left_m) < 0.05f, "it keeps to the middle of the tunnel");
    wrong += expect(height_m == 0.0f, "it lands when it is told to");
    wrong += expect(said > 300.0f, "it speaks five times a second");
    wrong += expect(deepest_m < HEAD_M, "it never passes the head");
    printf("took off at %d.%d s, hovered %d cm deep, filters %s\n", (int)launched_s,
           (int)(launched_s * 10.0f) % 10, (int)(levelled_m * 100.0f),
           isfinite(variable("imbalance_db")) ? "of both links" : "of no link");
#ifdef ON_CHIP
    printf("stack appMain %lu bytes\n", (unsigned long)(task_top - lowest) * 4);
#endif
    exit(wrong == 0 ? 0 : 1);
}

static void deliver(const uint8_t *bytes, uint8_t length, float distance_m)
{
    static P2PPacket packet;
    packet.size = length;
    packet.rssi = (uint8_t)(35.0f + 5.0f * distance_m + 0.5f);
    memcpy(packet.data, bytes, length);
    if (callback != NULL && !is_deaf) {
        callback(&packet);
    }
}

/* The base and the head speak, and now and then somebody else on the same channel. */
static void others_speak(void)
{
    uint8_t bytes[UCHAIN_PACKET_MAX];
    uchain_observation seen;
    uchain_command command;
    memset(&seen, 0, sizeof seen);
    seen.has_place = 1;
    seen.is_decision_due = 1;
    deliver(bytes, uchain_say(&head, &seen, bytes), fabsf(HEAD_M - at_m));
    (void)uchain_step(&head, &seen, &command);
    deliver(bytes, uchain_say_base((uint8_t)(now_ms / 200), bytes), fabsf(at_m));
    memset(bytes, (int)(now_ms % 251), sizeof bytes);
    deliver(bytes, (uint8_t)(now_ms / 200 % 31), 1.0f);
}

/* 50 ms of the world. */
static void advance(void)
{
    float wish_along_mps = (asked.velocity.x - asked.velocity.y) / ROOT;
    float wish_left_mps = (asked.velocity.x + asked.velocity.y) / ROOT;
    bool is_flying = asked.mode.z == modeAbs;
    height_m = is_flying ? asked.position.z : 0.0f;
    along_mps = is_flying ? along_mps + 0.2f * (wish_along_mps - along_mps) : 0.0f;
    left_mps = is_flying ? left_mps + 0.2f * (wish_left_mps - left_mps) : 0.0f;
    at_m += 0.05f * along_mps;
    left_m += 0.05f * left_mps;
    now_ms += 50;
    if (is_flying && launched_s == 0.0f) {
        launched_s = (float)now_ms / 1000.0f;
    }
    deepest_m = fmaxf(deepest_m, at_m);
    if (now_ms == LAND_AT_MS) {
        levelled_m = at_m;
        set("land", 1);
    }
    if (now_ms >= END_AT_MS) {
        end();
    }
    if (now_ms % 200 == 0) {
        others_speak();
    }
}

void vTaskDelay(TickType_t ticks)
{
    look();
    for (TickType_t waited = 0; waited < ticks; waited += 50) {
        advance();
    }
    /* The operator starts it after a while. */
    set("start", 1);
    paint();
}

void vTaskDelayUntil(TickType_t *woken, TickType_t period)
{
    look();
    advance();
    *woken += period;
    paint();
}

TickType_t xTaskGetTickCount(void)
{
    return now_ms;
}

static const char *const VARIABLES[] = { "front", "right", "left", "back", "statePX", "statePY", "batteryLevel" };

logVarId_t logGetVarId(const char *group, const char *name)
{
    (void)group;
    for (logVarId_t i = 0; i < sizeof VARIABLES / sizeof *VARIABLES; i++) {
        if (strcmp(VARIABLES[i], name) == 0) {
            return i;
        }
    }
    return UINT16_MAX;
}

float logGetFloat(logVarId_t one)
{
    /* Now and then a beam sees nothing, and distances are never twice the same. */
    float noise_mm = (float)(now_ms * 7u % 11u);
    if (now_ms % 1700 == 0 && one < 4) {
        return 32766.0f;
    }
    switch (one) {
    case 0: case 2: return (0.5f - left_m) * ROOT * 1000.0f + noise_mm;
    case 1: case 3: return (0.5f + left_m) * ROOT * 1000.0f + noise_mm;
    case 4: return (along_mps + left_mps) / ROOT;
    case 5: return (left_mps - along_mps) / ROOT;
    case 6: return 80.0f;
    default: return NAN;
    }
}

void commanderSetSetpoint(setpoint_t *setpoint, int priority)
{
    (void)priority;
    asked = *setpoint;
}

void p2pRegisterCB(P2PCallback given)
{
    callback = given;
}

bool radiolinkSendP2PPacketBroadcast(P2PPacket *packet)
{
    said += packet->size <= UCHAIN_PACKET_MAX ? 1.0f : 0.0f;
    return true;
}

uint64_t configblockGetRadioAddress(void)
{
    return 0xe7e7e7e7e7u;
}

int main(int argc, char **argv)
{
    uchain_params params;
    is_deaf = argc > 1 && strcmp(argv[1], "deaf") == 0;
    (void)uchain_params_default(&params);
    if (uchain_node_init(&head, UCHAIN_ROLE_HEAD, 1, &params) != UCHAIN_STATUS_OK) {
        return 1;
    }
#ifdef ON_CHIP
    task_top = stack_pointer();
    paint();
#endif
    appMain();
    return 1;
}
