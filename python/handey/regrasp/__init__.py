"""Grasps and placements as a graph: by which places does a part come from grasp to grasp?"""
