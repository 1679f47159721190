/* Stands in for the firmware's header of this name: packets from one Crazyflie to all others. The real one comes from the
 * firmware's tree. */
#ifndef RADIOLINK_H
#define RADIOLINK_H

#include <stdbool.h>
#include <stdint.h>

#define P2P_MAX_DATA_SIZE 60

typedef struct {
    /* Bytes of `data` that count. */
    uint8_t size;
    /* Received power in dBm, without its minus. */
    uint8_t rssi;
    uint8_t port;
    uint8_t data[P2P_MAX_DATA_SIZE];
} P2PPacket;

typedef void (*P2PCallback)(P2PPacket *packet);

void p2pRegisterCB(P2PCallback callback);
bool radiolinkSendP2PPacketBroadcast(P2PPacket *packet);

#endif
