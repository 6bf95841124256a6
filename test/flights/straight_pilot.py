#!/usr/bin/python3
"""The smallest pilot that `grid_path flights` can fly as a program (doc/flights.md): straight to one waypoint after
the other, whatever stands in between.

    straight_pilot.py [hover | climb | believe | babble | leave]    does one of these instead, for tests
"""
import json
import math
import sys

HABIT = sys.argv[1] if len(sys.argv) > 1 else "straight"
hello = json.loads(sys.stdin.buffer.readline())
waypoint = 0
while True:
    line = sys.stdin.buffer.readline()
    if not line or HABIT == "leave":
        break
    update = json.loads(line)
    frame = sys.stdin.buffer.read(update["frame_bytes"])  # float32 x, y, z of each pixel; not looked at
    x, y, z = update["position"]
    goal = hello["route"][waypoint]
    away = [goal[0] - x, goal[1] - y, goal[2] - z]
    distance = math.sqrt(sum(d * d for d in away))
    last = waypoint + 1 == len(hello["route"])
    answer = {"velocity": [0.0, 0.0, 0.0, 0.0], "status": "FLYING"}
    if HABIT == "babble":
        print("good morning", flush=True)
        continue
    if HABIT == "believe" or HABIT == "straight" and last and distance < hello["home_radius"]:
        answer.update(status="ARRIVED", sentence="arrived")
    elif HABIT == "climb":
        answer["velocity"][2] = hello["max_climb"]
    elif HABIT == "straight":
        if not last and distance < hello["arrival_radius"]:
            waypoint += 1
        speed = min(hello["max_speed"], distance) / max(distance, 1e-9)
        yaw = update["yaw"]
        answer["velocity"] = [speed * (math.cos(yaw) * away[0] + math.sin(yaw) * away[1]),
                              speed * (math.cos(yaw) * away[1] - math.sin(yaw) * away[0]), speed * away[2], 0.0]
    print(json.dumps(answer), flush=True)
