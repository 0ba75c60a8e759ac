# ros.py
import rclpy
from sensor_msgs.msg import Joy
from sticks import frames

rclpy.init()
node = rclpy.create_node('sbus')
publisher = node.create_publisher(Joy, 'joy', 1)
for channels, lost in frames():
    joy = Joy()
    joy.header.stamp = node.get_clock().now().to_msg()
    joy.axes = [0.0, 0.0, -1.0, 0.0] if lost else [max(-1.0, min(1.0, (raw - 992) / 819.5)) for raw in channels]
    joy.buttons = [int(not lost)]
    publisher.publish(joy)
