/* A Crazyflie 2.1 in a chain: the firmware's app layer calls appMain(), which shows the node what the decks measure twenty
 * times a second, flies what it asks for, and broadcasts what it says. README.md tells how to build it into the firmware.
 *
 * Decks: Flow v2 for speed and height, Multi-ranger for distances. Its beams look ahead, left, back and right, and the laws
 * want diagonals: the chain's "forward" is half-way between the body's front and its right. Put the drone down like that. */

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "FreeRTOS.h"
#include "app.h"
#include "commander.h"
#include "configblock.h"
#include "log.h"
#include "param.h"
#include "radiolink.h"
#include "task.h"

#include "uchain.h"

/* The loop, and how often in it the distances are new (10 Hz). */
#define LOOP_MS 50
#define LOOP_S 0.05f
#define TOF_EVERY 2

/* As many loops with the very same four distances, and the bus is dead. */
#define STUCK_LOOPS 20

#define FLIGHT_HEIGHT_M 0.3f
#define DESCENT_MPS 0.2f
#define LAND_BELOW_PERCENT 10u
#define SETPOINT_PRIORITY 3

#define HALF_ROOT 0.70710678f
#define DEGREES_PER_RAD 57.29578f

/* Set by the operator, as parameters of the group "uchain". */
enum { AS_HEAD = UCHAIN_ROLE_HEAD, AS_RELAY = UCHAIN_ROLE_RELAY, AS_BASE = 2 };
static uint8_t start;                    /* 1: begin; what follows is read then */
static uint8_t role = AS_RELAY;
static uint8_t place = 1;                /* 0 leads; fixed at the launch pad */
static float s_min_db = 60.0f;           /* loss from which the next one takes off: your radio's */
static uint8_t land;                     /* 1: come down where you are */
static float pilot_mps;                  /* the head: forward speed, negative backward */
static uint8_t pilot_follow = UCHAIN_FOLLOW_CENTRE;

/* What the node is made of, and what it makes: too large for the stack of an app. */
static uchain_node node;
static uchain_params params;
static uchain_explanation why;
static uint8_t fault;                    /* a uchain_status: why it does not start */

/* Packets on their way from the radio's task to this one: one writes `written`, the other `taken`. */
#define INBOX 8u
static struct {
    uint8_t bytes[UCHAIN_PACKET_MAX];
    uint8_t length;
    uint8_t loss_db;
} inbox[INBOX];
static volatile uint32_t written, taken;

/* The radio's task. It gives the received power without its minus: the loss. */
static void received(P2PPacket *packet)
{
    uint32_t at = written;
    if (at - taken >= INBOX || packet->size > UCHAIN_PACKET_MAX) {
        return;
    }
    memcpy(inbox[at % INBOX].bytes, packet->data, packet->size);
    inbox[at % INBOX].length = packet->size;
    inbox[at % INBOX].loss_db = packet->rssi;
    __sync_synchronize();
    written = at + 1;
}

static void hear_all(void)
{
    for (; taken != written; taken++) {
        uint32_t at = taken % INBOX;
        /* What is no packet of the chain is answered by a status, and that is all. */
        (void)uchain_hear(&node, inbox[at].bytes, inbox[at].length, (float)inbox[at].loss_db);
        __sync_synchronize();
    }
}

/* The first byte that goes out is the packet's: no other traffic shares the port. */
static void broadcast(const uint8_t *bytes, uint8_t length)
{
    static P2PPacket packet;
    packet.port = 0;
    packet.size = length;
    memcpy(packet.data, bytes, length);
    (void)radiolinkSendP2PPacketBroadcast(&packet);
}

/* Distances in metres; NaN for all of them if the deck hangs. */
static void look(uchain_observation *seen)
{
    static const char *const BEAMS[4] = { "front", "right", "left", "back" };
    static logVarId_t beams[4];
    static bool known;
    static float last_m[4];
    static int same;
    float *into[4] = { &seen->tof_nw_m, &seen->tof_ne_m, &seen->tof_sw_m, &seen->tof_se_m };
    bool moved = false;
    for (int i = 0; i < 4; i++) {
        if (!known) {
            beams[i] = logGetVarId("range", BEAMS[i]);
        }
        float distance_m = logGetFloat(beams[i]) / 1000.0f;
        moved = moved || distance_m != last_m[i];
        last_m[i] = distance_m;
    }
    known = true;
    same = moved ? 0 : same + 1;
    for (int i = 0; i < 4; i++) {
        *into[i] = same * TOF_EVERY < STUCK_LOOPS ? last_m[i] : NAN;
    }
    seen->has_tof = 1;
}

/* What is seen at this turn of the loop. */
static void sense(uchain_observation *seen, uint32_t turn, bool is_due)
{
    static logVarId_t vx, vy, charge;
    if (turn == 0) {
        vx = logGetVarId("kalman", "statePX");
        vy = logGetVarId("kalman", "statePY");
        charge = logGetVarId("pm", "batteryLevel");
    }
    memset(seen, 0, sizeof *seen);
    seen->place = place;
    seen->has_place = 1;
    seen->is_decision_due = is_due;
    /* Speeds in the body's frame, turned into the chain's. */
    seen->ground_speed_mps = (logGetFloat(vx) - logGetFloat(vy)) * HALF_ROOT;
    seen->has_ground_speed = 1;
    seen->battery = logGetFloat(charge) / 100.0f;
    seen->has_battery = 1;
    if (role == AS_HEAD) {
        seen->pilot_speed_mps = pilot_mps;
        seen->pilot_follow = pilot_follow;
        seen->has_pilot = 1;
    }
    if (turn % TOF_EVERY == 0) {
        look(seen);
    }
}

/* A velocity in the body's frame, at a height; at height 0 the motors stand still. */
static void fly(const uchain_command *command, float height_m)
{
    static setpoint_t setpoint;
    memset(&setpoint, 0, sizeof setpoint);
    if (height_m > 0.0f) {
        setpoint.mode.x = modeVelocity;
        setpoint.mode.y = modeVelocity;
        setpoint.mode.z = modeAbs;
        setpoint.mode.yaw = modeVelocity;
        setpoint.velocity.x = (command->forward_mps + command->lateral_mps) * HALF_ROOT;
        setpoint.velocity.y = (command->lateral_mps - command->forward_mps) * HALF_ROOT;
        setpoint.velocity_body = true;
        setpoint.position.z = height_m;
        setpoint.attitudeRate.yaw = command->yaw_rate_radps * DEGREES_PER_RAD;
    }
    commanderSetSetpoint(&setpoint, SETPOINT_PRIORITY);
}

/* The height of the next turn: up within `takeoff.rise_s`, down slowly. */
static float next_height_m(float height_m, bool is_up)
{
    float rise_m = FLIGHT_HEIGHT_M * LOOP_S / (params.takeoff_rise_s > LOOP_S ? params.takeoff_rise_s : LOOP_S);
    if (is_up) {
        return fminf(height_m + rise_m, FLIGHT_HEIGHT_M);
    }
    return fmaxf(height_m - DESCENT_MPS * LOOP_S, 0.0f);
}

/* Makes the node. False: the parameters are wrong, and `fault` says so. */
static bool make(uint16_t id)
{
    (void)uchain_params_default(&params);
    params.takeoff_s_min_db = s_min_db;
    /* What the Multi-ranger's sensors see in the dark of a tunnel. */
    params.tof_range_m = 2.0f;
    if ((role == AS_HEAD) != (place == 0)) {
        /* Place 0 leads the chain, and nobody else does. */
        fault = UCHAIN_STATUS_BAD_CHOICE;
    } else if (uchain_abi_version() != UCHAIN_ABI_VERSION) {
        fault = UCHAIN_STATUS_OTHER_VERSION;
    } else {
        fault = uchain_node_init(&node, role, id, &params);
    }
    return fault == UCHAIN_STATUS_OK;
}

/* The base stands still and says so, five times a second. */
static void stay(uint32_t turn)
{
    uint8_t bytes[UCHAIN_PACKET_MAX];
    if (turn % 4 == 0) {
        broadcast(bytes, uchain_say_base((uint8_t)(turn / 4), bytes));
    }
}

/* One turn of who flies. What the height is afterwards. */
static float turn_of_node(uint32_t turn, uint32_t period, float height_m)
{
    uchain_observation seen;
    uchain_command command;
    const bool is_due = turn % period == 0;
    sense(&seen, turn, is_due);
    hear_all();
    if (is_due) {
        uint8_t bytes[UCHAIN_PACKET_MAX];
        uint8_t length = uchain_say(&node, &seen, bytes);
        if (length > 0) {
            broadcast(bytes, length);
        }
    }
    /* Whatever is wrong, the command says hover, or stay on the ground. */
    (void)uchain_step(&node, &seen, &command);
    if (is_due) {
        (void)uchain_explain(&node, &seen, &why);
    }
    if (land || (seen.battery * 100.0f < (float)LAND_BELOW_PERCENT && height_m > 0.0f)) {
        land = 1;
        memset(&command, 0, sizeof command);
    }
    height_m = next_height_m(height_m, command.airborne);
    fly(&command, height_m);
    return height_m;
}

void appMain(void)
{
    TickType_t woken;
    float height_m = 0.0f;
    uint32_t period;
    /* The last byte of the radio address is the id, as it is on the sticker. */
    const uint16_t id = (uint16_t)(configblockGetRadioAddress() & 0xff);

    while (!start) {
        vTaskDelay(M2T(LOOP_MS));
    }
    if (role != AS_BASE && !make(id)) {
        /* Read `uchain.fault`, and start again. */
        for (;;) {
            vTaskDelay(M2T(1000));
        }
    }
    period = (uint32_t)(params.equalize_decision_s / LOOP_S + 0.5f);
    p2pRegisterCB(received);
    woken = xTaskGetTickCount();
    for (uint32_t turn = 0;; turn++) {
        if (role == AS_BASE) {
            stay(turn);
        } else {
            height_m = turn_of_node(turn, period, height_m);
        }
        vTaskDelayUntil(&woken, M2T(LOOP_MS));
    }
}

PARAM_GROUP_START(uchain)
PARAM_ADD(PARAM_UINT8, start, &start)
PARAM_ADD(PARAM_UINT8, role, &role)
PARAM_ADD(PARAM_UINT8, place, &place)
PARAM_ADD(PARAM_FLOAT, s_min_db, &s_min_db)
PARAM_ADD(PARAM_UINT8, land, &land)
PARAM_ADD(PARAM_FLOAT, pilot_mps, &pilot_mps)
PARAM_ADD(PARAM_UINT8, pilot_follow, &pilot_follow)
PARAM_GROUP_STOP(uchain)

LOG_GROUP_START(uchain)
LOG_ADD(LOG_UINT8, fault, &fault)
LOG_ADD(LOG_UINT8, stage, &why.stage)
LOG_ADD(LOG_UINT8, overridden, &why.overridden)
LOG_ADD(LOG_FLOAT, back_db, &why.back_filtered_db)
LOG_ADD(LOG_FLOAT, front_db, &why.front_filtered_db)
LOG_ADD(LOG_FLOAT, imbalance_db, &why.imbalance_db)
LOG_GROUP_STOP(uchain)
