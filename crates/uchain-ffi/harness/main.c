/* What C makes of the steps that the program `reference` wrote down: the same bits, or the step `ffi` of the gate fails.
 *
 *   harness asked.bin replies.bin [plant]   answers every step; `plant` spoils the last bit of one loss, as a control
 *   harness abuse                           wrong pointers, bytes, choices and numbers: a status, and no crash
 *
 * Both sides are little-endian, and the files hold structs as they lie in memory. */

#include <stdio.h>
#include <string.h>

#include "abuse.h"
#include "stack.h"
#include "uchain.h"

enum { UAVS = 8, ASKED_BYTES = 48, REPLY_BYTES = 108 };

/* A line of asked.bin: what it means depends on its kind. */
enum { END = 0, INIT = 1, HEAR = 2, STEP = 3 };

struct asked {
    uint8_t kind;
    uint8_t uav;
    /* INIT: role; HEAR: number of bytes. */
    uint8_t a;
    /* INIT: preset. */
    uint8_t b;
    /* INIT: id; HEAR: bits of the loss. */
    uint32_t c;
    /* HEAR: the bytes; STEP: a uchain_observation. */
    uint8_t payload[UCHAIN_OBSERVATION_BYTES];
};

typedef char asked_has_its_size[sizeof(struct asked) == ASKED_BYTES ? 1 : -1];

static uchain_node nodes[UAVS];

static int refused(const char *what, unsigned long line)
{
    fprintf(stderr, "record %lu: %s is refused\n", line, what);
    return 1;
}

static uchain_status preset(uint8_t which, uchain_params *params)
{
    switch (which) {
    case 0: return uchain_params_default(params);
    case 1: return uchain_params_frontiers2021(params);
    case 2: return uchain_params_cavemod(params);
    default: return UCHAIN_STATUS_BAD_CHOICE;
    }
}

static uchain_status init(const struct asked *asked)
{
    uchain_params params;
    uchain_status status = UCHAIN_STATUS_OK;
    STACK_OF(STACK_PARAMS, status = preset(asked->b, &params));
    if (status != UCHAIN_STATUS_OK) {
        return status;
    }
    STACK_OF(STACK_INIT, status = uchain_node_init(&nodes[asked->uav], asked->a, (uint16_t)asked->c, &params));
    return status;
}

static uchain_status hear(const struct asked *asked, uint32_t spoilt)
{
    float loss_db;
    uint32_t bits = asked->c ^ spoilt;
    memcpy(&loss_db, &bits, sizeof loss_db);
    return uchain_hear(&nodes[asked->uav], asked->payload, asked->a, loss_db);
}

/* What the node says, asks for and believes, without the gaps that a struct has. */
static void step(const struct asked *asked, uint8_t reply[REPLY_BYTES])
{
    uchain_node *node = &nodes[asked->uav];
    uchain_observation seen;
    uchain_command command;
    uchain_explanation why;
    memset(reply, 0, REPLY_BYTES);
    memcpy(&seen, asked->payload, sizeof seen);
    if (seen.is_decision_due) {
        STACK_OF(STACK_SAY, reply[3] = uchain_say(node, &seen, reply + 76));
    }
    STACK_OF(STACK_STEP, reply[0] = uchain_step(node, &seen, &command));
    STACK_OF(STACK_EXPLAIN, reply[1] = uchain_explain(node, &seen, &why));
    reply[2] = command.airborne;
    memcpy(reply + 4, &command, 12);
    memcpy(reply + 16, &why, 55);
}

/* The packet that is spoilt: somewhere in the middle of a flight. */
enum { SPOILT = 5000 };

static int answer(const char *from, const char *to, int plants)
{
    FILE *in = fopen(from, "rb");
    FILE *out = fopen(to, "wb");
    unsigned long line = 0, steps = 0, heard = 0;
    struct asked asked;
    uint8_t reply[REPLY_BYTES];
    if (in == NULL || out == NULL) {
        fprintf(stderr, "cannot open %s, or cannot write %s\n", from, to);
        return 1;
    }
    for (;; line++) {
        if (fread(&asked, 1, sizeof asked, in) != sizeof asked || asked.uav >= UAVS) {
            return refused("a record that is cut off, or of a UAV too many,", line);
        }
        if (asked.kind == END) {
            break;
        } else if (asked.kind == INIT) {
            if (init(&asked) != UCHAIN_STATUS_OK) {
                return refused("a node", line);
            }
        } else if (asked.kind == HEAR) {
            uchain_status status = UCHAIN_STATUS_OK;
            uint32_t spoilt = plants && ++heard == SPOILT ? 1u : 0u;
            STACK_OF(STACK_HEAR, status = hear(&asked, spoilt));
            if (status != UCHAIN_STATUS_OK) {
                return refused("a packet", line);
            }
        } else {
            step(&asked, reply);
            steps++;
            if (fwrite(reply, 1, sizeof reply, out) != sizeof reply) {
                fprintf(stderr, "cannot write %s\n", to);
                return 1;
            }
        }
    }
    fclose(in);
    if (fclose(out) != 0) {
        fprintf(stderr, "cannot write %s\n", to);
        return 1;
    }
    printf("%lu steps\n", steps);
    stack_report();
    return 0;
}

int main(int argc, char **argv)
{
    if (uchain_abi_version() != UCHAIN_ABI_VERSION) {
        fprintf(stderr, "the library has another ABI version than its header\n");
        return 1;
    }
    if (argc == 2 && strcmp(argv[1], "abuse") == 0) {
        return abuse();
    }
    if (argc == 3 || (argc == 4 && strcmp(argv[3], "plant") == 0)) {
        return answer(argv[1], argv[2], argc == 4);
    }
    fprintf(stderr, "usage: harness asked.bin replies.bin [plant] | harness abuse\n");
    return 2;
}
