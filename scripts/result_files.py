"""Maps and clouds as estimate writes them."""
import numpy as np


def read_pfm(path):
    """Rows from top to bottom, float32. ValueError if it is no PFM of one channel."""
    with open(path, 'rb') as file:
        if file.readline().strip() != b'Pf':
            raise ValueError(f'{path} is no PFM of one channel.')
        width, height = (int(word) for word in file.readline().split())
        order = '<f4' if float(file.readline()) < 0 else '>f4'
        values = np.frombuffer(file.read(), order)
    if values.size != width * height:
        raise ValueError(f'{path} has {values.size} values instead of {width} x {height}.')
    return values.reshape(height, width)[::-1].astype(np.float32)


def read_ply(path):
    """Positions (N x 3, metres) and colours (N x 3) of the vertices of a binary PLY."""
    types = {'float': 'f4', 'uchar': 'u1', 'uint8': 'u1', 'float32': 'f4'}
    with open(path, 'rb') as file:
        fields, count = [], 0
        for line in iter(file.readline, b'end_header\n'):
            words = line.decode('ascii').split()
            if not words:
                raise ValueError(f'{path} is no PLY.')
            if words[0] == 'element':
                count = int(words[2])
            elif words[0] == 'property':
                fields.append((words[2], '<' + types[words[1]]))
        points = np.frombuffer(file.read(), np.dtype(fields), count)
    position = np.stack([points[axis] for axis in 'xyz'], axis=1)
    colour = np.stack([points[name] for name in ('red', 'green', 'blue')], axis=1)
    return position, colour
