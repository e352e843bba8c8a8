#!/usr/bin/python3
"""Holds what other packages make of the node's results against the node's own.

usage: check_peers.py FOLDER [SECONDS]

Run by scripts/check_peers.sh beside peers.launch. Of one frame the clouds of stereo_image_proc/point_cloud2, depth_image_proc/point_cloud_xyz and
point_cloud_xyzrgb must be those of ~points2 within 1e-4 of their depth, the disparity of depth_image_proc/disparity that
of ~disparity, and the depth of convert_metric ~depth within half a millimetre; topic_tools passes messages on,
rosbag records and filters them, pointcloud_to_pcd writes points2, and image_view the coloured disparity. Exits 1 with a sentence for each that is not so.
"""
import os
import subprocess
import sys
import threading
import time

import numpy as np
import rosbag
import rospy
from sensor_msgs.msg import Image, PointCloud2
from stereo_msgs.msg import DisparityImage

NODE = '/light_field_depth/'
TOLERANCE = 1e-4
CLOSING_S = 20.0  # of a bag
TOPICS = {NODE + 'points2': PointCloud2, NODE + 'disparity': DisparityImage, NODE + 'depth': Image,
          '/peers/stereo/points': PointCloud2, '/peers/xyz/points': PointCloud2, '/peers/xyzrgb/points': PointCloud2,
          '/peers/metric/depth': Image, '/peers/disparity': DisparityImage, '/peers/throttled': DisparityImage}
OPTIONAL = {'/peers/throttled'}


class Collector:
    """Messages of all topics by their stamps."""

    def __init__(self):
        self.lock = threading.Lock()
        self.messages = {topic: {} for topic in TOPICS}
        self.subscribers = [rospy.Subscriber(topic, kind, self.take, topic, queue_size=2, buff_size=1 << 26)
                            for topic, kind in TOPICS.items()]

    def take(self, message, topic):
        with self.lock:
            self.messages[topic][message.header.stamp.to_nsec()] = message

    def whole_frame(self):
        with self.lock:
            wanted = [set(stamps) for topic, stamps in self.messages.items() if topic not in OPTIONAL]
            common = set.intersection(*wanted)
            if not common or not all(self.messages[topic] for topic in OPTIONAL):
                return None
            stamp = max(common)
            return {topic: stamps.get(stamp) for topic, stamps in self.messages.items()}


def points(cloud):
    """x, y, z of every pixel."""
    offsets = {field.name: field.offset for field in cloud.fields}
    data = np.frombuffer(cloud.data, np.uint8).reshape(cloud.height, cloud.row_step)
    data = data[:, :cloud.width * cloud.point_step].reshape(cloud.height, cloud.width, cloud.point_step)
    return np.stack([np.ascontiguousarray(data[:, :, offsets[name]:offsets[name] + 4]).view(np.float32)[:, :, 0]
                     for name in 'xyz'], -1).astype(np.float64)


def floats(image):
    return np.frombuffer(image.data, np.float32).reshape(image.height, image.step // 4)[:, :image.width].astype(np.float64)


def compare(name, ours, theirs, scale, tolerance):
    """@return a sentence if what both have differs, or one has much that the other has not."""
    both = np.isfinite(ours) & np.isfinite(theirs)
    if both.ndim == 3:
        both = both.all(-1)
    alone = np.isfinite(ours.reshape(both.shape + (-1,))[..., -1]) ^ np.isfinite(theirs.reshape(both.shape + (-1,))[..., -1])
    worst = (np.abs(ours - theirs)[both] / (scale[both][:, None] if ours.ndim == 3 else scale[both])).max() if both.any() else np.inf
    print(f'{name}: {100.0 * both.mean():.1f} % of the pixels in both, {100.0 * alone.mean():.2f} % in one alone, '
          f'largest difference {worst:.2e}')
    return '' if worst <= tolerance and alone.mean() < 0.01 else f'{name} is not what the node publishes.'


def check(frame, folder):
    cloud = points(frame[NODE + 'points2'])
    depth = floats(frame[NODE + 'depth'])
    disparity = frame[NODE + 'disparity']
    values = floats(disparity.image)
    values[values < disparity.min_disparity] = np.nan
    problems = [compare(topic, cloud, points(frame[f'/peers/{topic}/points']), cloud[..., 2], TOLERANCE)
                for topic in ('stereo', 'xyz', 'xyzrgb')]
    theirs = frame['/peers/disparity']
    found = floats(theirs.image)
    found[found <= 0] = np.nan
    problems.append(compare('disparity', values, found, values, TOLERANCE))
    metric = floats(frame['/peers/metric/depth'])
    metric[metric == 0] = np.nan
    problems.append(compare('convert_metric', depth, metric, np.ones_like(depth), 0.00051))
    for program, ending in (('pointcloud_to_pcd', '.pcd'), ('image_view', '.png')):
        count = sum(name.endswith(ending) for name in os.listdir(folder))
        print(f'{count} files of {program}')
        if count == 0:
            problems.append(f'{program} has written nothing.')
    return [problem for problem in problems if problem]


def check_bag(folder):
    """Stops the recorder, so that its bag is whole, and takes one topic out of it."""
    subprocess.run(['rosnode', 'kill', '/recorder'], check=True, stdout=subprocess.DEVNULL)
    path = os.path.join(folder, 'results.bag')
    end = time.monotonic() + CLOSING_S
    while not os.path.exists(path) and time.monotonic() < end:
        time.sleep(0.1)
    if not os.path.exists(path):
        return ['rosbag has recorded nothing.']
    filtered = os.path.join(folder, 'disparity.bag')
    subprocess.run(['rosbag', 'filter', path, filtered, f"topic == '{NODE}disparity'"], check=True, stdout=subprocess.DEVNULL)
    with rosbag.Bag(path) as bag, rosbag.Bag(filtered) as chosen:
        recorded = bag.get_message_count(NODE + 'disparity')
        kept = chosen.get_message_count()
    print(f'{recorded} disparity images in the bag, {kept} when it is filtered')
    return [] if recorded == kept > 0 else ['The bag of the results is not what was published.']


def main():
    folder = sys.argv[1]
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 60.0
    rospy.init_node('check_peers', anonymous=True)
    collector = Collector()
    end = rospy.Time.now() + rospy.Duration(seconds)
    frame = None
    while frame is None and rospy.Time.now() < end and not rospy.is_shutdown():
        rospy.sleep(0.2)
        frame = collector.whole_frame()
    if frame is None:
        missing = [topic for topic, stamps in collector.messages.items() if not stamps]
        sys.exit(f'No frame came on all topics in {seconds:.0f} s; nothing at all on: {", ".join(missing) or "none of them"}')
    problems = check(frame, folder) + check_bag(folder)
    if problems:
        sys.exit('\n'.join(problems))


if __name__ == '__main__':
    main()
