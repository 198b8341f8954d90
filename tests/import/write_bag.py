#!/usr/bin/python3
# mrpt_fastlio: writes a bag of ROS 1 with Debian's python3-rosbag, from the files of the conformance test.
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: write_bag.py DUMP OUT.bag none|bz2|lz4

DUMP/imu.csv: stamp [ns], angular rate, specific force; DUMP/scans/STAMP.bin: x y z intensity (float), time after the
stamp [ns] (uint32), line (uint16) of each point."""
import glob
import os
import sys

import genpy
import rosbag
from sensor_msgs.msg import Imu, PointCloud2, PointField

POINT_BYTES = 22


def stamp_of(nanoseconds):
    return genpy.Time(nanoseconds // 10**9, nanoseconds % 10**9)


def imu_messages(path):
    for line in open(path):
        stamp, *values = line.split(",")
        message = Imu()
        message.header.stamp = stamp_of(int(stamp))
        message.header.frame_id = "imu"
        message.orientation_covariance[0] = -1
        w, a = message.angular_velocity, message.linear_acceleration
        w.x, w.y, w.z, a.x, a.y, a.z = map(float, values)
        yield int(stamp), "/imu", message


def cloud_messages(folder):
    for path in glob.glob(os.path.join(folder, "*.bin")):
        stamp = int(os.path.basename(path)[:-4])
        message = PointCloud2()
        message.header.stamp = stamp_of(stamp)
        message.header.frame_id = "lidar"
        fields = [("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("intensity", 12, 7), ("t", 16, 6), ("ring", 20, 4)]
        message.fields = [PointField(name, offset, kind, 1) for name, offset, kind in fields]
        message.data = open(path, "rb").read()
        message.height = 1
        message.width = len(message.data) // POINT_BYTES
        message.point_step = POINT_BYTES
        message.row_step = len(message.data)
        message.is_dense = True
        yield stamp, "/lidar", message


dump, out, compression = sys.argv[1:]
messages = list(imu_messages(os.path.join(dump, "imu.csv"))) + list(cloud_messages(os.path.join(dump, "scans")))
messages.sort(key=lambda entry: entry[0])
with rosbag.Bag(out, "w", compression=compression, chunk_threshold=256 * 1024) as bag:
    for stamp, topic, message in messages:
        bag.write(topic, message, t=stamp_of(stamp))
