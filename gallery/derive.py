"""Finds numbers of the gallery by other means than corank: Newton's method from random starts, and closed forms, in doubles.

    python3 gallery/derive.py

What it prints is a lower bound of the number of solutions: those that it finds. Entries that rest on it say so in `derived`.
"""

import itertools

import numpy as np

RANDOM = np.random.default_rng(7)
PI = np.pi


def roots(residual, unknowns, starts, angles=slice(None), spread=PI):
    """The distinct roots that Newton's method (with pseudo-inverses of differences) reaches, angles modulo whole turns."""
    found = []
    for _ in range(starts):
        x = RANDOM.uniform(-spread, spread, unknowns)
        for _ in range(60):
            f = residual(x)
            if np.linalg.norm(f) < 1e-11 or not np.all(np.isfinite(f)):
                break
            h = 1e-7
            jacobian = np.array([(residual(x + h * e) - residual(x - h * e)) / (2 * h) for e in np.eye(unknowns)]).T
            step = np.linalg.lstsq(jacobian, f, rcond=None)[0]
            x = x - step * min(1, 1 / max(np.linalg.norm(step), 1e-12))
        if not np.linalg.norm(residual(x)) < 1e-9:
            continue
        x[angles] = np.remainder(x[angles] + PI, 2 * PI) - PI
        turn = np.zeros(unknowns, bool)
        turn[angles] = True
        apart = [np.abs(np.where(turn, np.remainder(x - y + PI, 2 * PI) - PI, x - y)).max() for y in found]
        if not apart or min(apart) > 1e-5:
            found.append(x)
    return found


def turn(axis, angle):
    c, s = np.cos(angle), np.sin(angle)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    matrix = np.eye(3)
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = -s, s
    return matrix


def hand(rows, angles):
    """Denavit and Hartenberg's standard convention; rows of a, alpha in degrees, d."""
    place, frame = np.zeros(3), np.eye(3)
    for (a, alpha, d), q in zip(rows, angles):
        place = place + frame @ np.array([a * np.cos(q), a * np.sin(q), d])
        frame = frame @ turn(2, q) @ turn(0, np.radians(alpha))
    return place, frame


def postures(rows, place, z, y, x, starts):
    frame = turn(2, z) @ turn(1, y) @ turn(0, x)

    def residual(q):
        p, r = hand(rows, q)
        return np.concatenate([p - place, (r - frame).ravel()])

    return len(roots(residual, len(rows), starts))


def arms():
    usual = ((0.4, 0.2, 0.5), 0.3, np.radians(40), 0)
    yield "puma_560: postures", postures(
        [(0, 90, 0), (0.4318, 0, 0), (0.0203, -90, 0.15005), (0, 90, 0.4318), (0, -90, 0), (0, 0, 0)], *usual, 300
    )
    yield "ur5: postures", postures(
        [(0, 90, 0.089159), (-0.425, 0, 0), (-0.39225, 0, 0), (0, 90, 0.10915), (0, -90, 0.09465), (0, 0, 0.0823)],
        *usual,
        300,
    )
    yield "gofa: postures", postures(
        [(0, 90, 0.265), (0.444, 0, 0), (0.11, -90, 0), (0, 90, 0.47), (0.08, -90, 0), (0, 0, 0.101)],
        (-0.08, 0.01, -0.04),
        -1.911101,
        -0.672986,
        1.508262,
        1500,
    )
    yield "crx: postures", postures(
        [(0, -90, 0), (0.71, 0, 0), (0, -90, 0), (0, 90, 0.54), (0, -90, 0.15), (0, 0, 0.16)],
        (-0.26, 0.18, -0.29),
        0.14845,
        -0.544541,
        -0.964748,
        1500,
    )
    yield "sixteen_6r: postures", postures(
        [(0.3, 90, 0), (1, 1, 0), (0, 90, 0.2), (1.5, 1, 0), (0, 90, 0), (0, 1, 0)],
        (-1.140165, 0, 0),
        2.967948,
        0.689251,
        1.459702,
        1500,
    )

    def orthogonal(q):
        # link1 along x to the second axis, y; link2 with its offset along that axis; the third axis, -y of link2.
        second = turn(2, q[0]) @ turn(0, -PI / 2) @ turn(2, q[1])
        third = second @ turn(0, PI / 2) @ turn(2, q[2])
        return (
            turn(2, q[0]) @ np.array([1, 0, 0])
            + second @ np.array([2, 0, 1])
            + third @ np.array([1.5, 0, 0])
            - np.array([2, 0.3, 0.4])
        )

    yield "orthogonal_3r: postures", len(roots(orthogonal, 3, 300))


def cusps_of_3r(d3, d4, r2):
    """Along the locus c2 = -s3/k, without the curve h = 0: where rho^2 + z^2 and z^2 turn back; theta2 of either sign."""
    t = np.linspace(-PI, PI, 400001)
    h, k = d3 + d4 * np.cos(t), d3 * np.sin(t) - r2 * np.cos(t)
    c2 = -np.sin(t) / k
    squares = np.array([1 + 2 * h * c2 + h**2 + (r2 + d4 * np.sin(t)) ** 2, h**2 * (1 - c2**2)])
    steps = np.diff(squares)
    turns = np.all(steps[:, 1:] * steps[:, :-1] < 0, axis=0)
    inside = np.abs(c2) <= 1
    smooth = np.abs(np.diff(c2)) < 0.5
    return 2 * np.sum(turns & inside[2:] & inside[1:-1] & inside[:-2] & smooth[1:] & smooth[:-1])


def degenerate_3rpr(cx, cy):
    """The places |w| of the cusps of degenerate_3rpr: where both other legs turn back along the singular curve."""
    h = np.linspace(0, PI, 400001) + 1e-4
    s, m = np.sin(h), cy * np.cos(h) - cx * np.sin(h)
    w = 2 * s * m * (np.cos(h) - cy * np.sin(h) - cx * np.cos(h)) / cy
    steps = np.diff(np.array([s * (s - w), m * (m + w)]))
    return np.sort(np.abs(w[1:-1][np.all(steps[:, 1:] * steps[:, :-1] < 0, axis=0)]))


def rpr_2prr(leg):
    """Cusps by Newton's method in the angles of leg and platform: the slides' gradients and the curve's are dependent."""

    def gradients(q, sides):  # of the slides, times the rods' extents along them
        rows = []
        for (bx, by), line, side in zip([(1, 0), (0.5, 0.6)], [0, 1.5], sides):
            rx, ry = np.cos(q[1]) * bx - np.sin(q[1]) * by, np.sin(q[1]) * bx + np.cos(q[1]) * by
            rise = leg * np.sin(q[0]) + ry - line
            run = side * np.sqrt(4 - rise**2)
            rows.append([-leg * np.sin(q[0]) * run + rise * leg * np.cos(q[0]), -ry * run + rise * rx])
        return rows

    def slopes(f, q, h):
        return [(f(q + h * e) - f(q - h * e)) / (2 * h) for e in np.eye(2)[:, :, None]]

    total = 0
    for sides in itertools.product([1, -1], repeat=2):

        def singular(q):
            (a, b), (c, d) = gradients(q, sides)
            return a * d - b * c

        def cusp(q):
            (a, b), (c, d) = gradients(q, sides)
            first = a * a + b * b >= c * c + d * d
            by_leg, by_platform = slopes(singular, q, 1e-5)
            return by_leg * np.where(first, b, d) - by_platform * np.where(first, a, c)

        q = np.stack(np.meshgrid(*2 * [np.linspace(-PI, PI, 70)])).reshape(2, -1) + 0.01
        with np.errstate(all="ignore"):
            for _ in range(30):
                f, g = singular(q), cusp(q)
                (fa, fb), (ga, gb) = slopes(singular, q, 1e-4), slopes(cusp, q, 1e-4)
                step = np.array([gb * f - fb * g, fa * g - ga * f]) / (fa * gb - fb * ga)
                q = q - step / np.maximum(1, np.linalg.norm(step, axis=0) / 0.1)
            good = q[:, (np.abs(singular(q)) < 1e-10) & (np.abs(cusp(q)) < 1e-7)]
        found = []
        for x in good.T:
            if not any(np.abs(np.remainder(x - y + PI, 2 * PI) - PI).max() < 1e-4 for y in found):
                found.append(x)
        total += len(found)
    return total


def corners(radius):
    return [radius * np.array([np.cos(2 * PI * k / 3), np.sin(2 * PI * k / 3), 0]) for k in range(3)]


def parallel_robots():
    legs = (1.75, 1.98, 2.09)

    def rps(x):  # the hinges' angles: from each leg's end to the next is a side of the platform
        ends = [
            a + d * (np.cos(h) * np.array([0, 0, 1]) + np.sin(h) * a / np.linalg.norm(a))
            for a, d, h in zip(corners(1), legs, x)
        ]
        side = 0.6 * np.sqrt(3)
        return np.array([np.linalg.norm(ends[i] - ends[(i + 1) % 3]) - side for i in range(3)])

    yield "rps_postures: postures", len(roots(rps, 3, 600))

    def delta(x):
        elbows = [(1 - 0.5 + np.cos(a)) * e - np.array([0, 0, np.sin(a)]) for a, e in zip((1, 1.1, 1.2), corners(1))]
        return np.array([np.linalg.norm(x - e) - 1.2 for e in elbows])

    yield "delta: positions", len(roots(delta, 3, 200, angles=slice(0)))

    def agile(e):  # the platform's joints are perpendicular to the cranks' ends
        frame = turn(2, e[2]) @ turn(1, e[1]) @ turn(0, e[0])
        t = (0.3, 0.5, 0.4)
        ends = [
            np.array([0, np.cos(t[0]), np.sin(t[0])]),
            np.array([np.sin(t[1]), 0, np.cos(t[1])]),
            np.array([np.cos(t[2]), np.sin(t[2]), 0]),
        ]
        return np.array([ends[k] @ frame[:, k] for k in range(3)])

    frames = []
    for e in roots(agile, 3, 600):
        frame = turn(2, e[2]) @ turn(1, e[1]) @ turn(0, e[0])
        if not any(np.abs(frame - f).max() < 1e-5 for f in frames):
            frames.append(frame)
    yield "agile_eye: orientations", len(frames)


def upu(legs, starts):
    """Tsai's 3-UPU: a leg is perpendicular to the middle axis, which is perpendicular to both outer ones."""
    outward = [np.array([np.cos(a), np.sin(a), 0]) for a in 2 * PI / 3 * np.arange(3)]

    def gaps(x):
        frame = turn(2, x[5]) @ turn(1, x[4]) @ turn(0, x[3])
        f = []
        for r, length in zip(outward, legs):
            axis, leg = np.cross([0, 0, 1], r), x[:3] + 0.5 * frame @ r - r
            f += [leg @ leg - length**2, np.cross(axis, frame @ axis) @ leg]
        return np.array(f)

    poses = []
    for x in roots(gaps, 6, starts, angles=slice(3, 6)):
        pose = np.append(x[:3], turn(2, x[5]) @ turn(1, x[4]) @ turn(0, x[3]))
        if not any(np.abs(pose - p).max() < 1e-5 for p in poses):
            poses.append(pose)
    return len(poses)


def hexapod(place):
    """The determinant of the lines of the six legs of stewart_line and sphere_6ups."""
    base = [np.array([np.cos(k * PI / 12), np.sin(k * PI / 12), 0]) for k in (1, 7, 9, 15, 17, 23)]
    top = [0.6 * np.array([np.cos(k * PI / 12), np.sin(k * PI / 12), 0]) for k in (3, 5, 11, 13, 19, 21)]
    frame = turn(2, 0.2) @ turn(1, 0.1) @ turn(0, 0.3)
    ends = [place + frame @ b for b in top]
    return np.linalg.det([np.concatenate([b - a, np.cross(a, b)]) for a, b in zip(base, ends)])


def stewart_line(x, y):
    """The real roots of the cubic in z by which the six legs' lines are dependent."""
    places = np.linspace(-3.5, 3.5, 9)
    cubic = np.polyfit(places, [hexapod(np.array([x, y, z])) for z in places], 5)
    assert np.abs(cubic[:2]).max() < 1e-9 * np.abs(cubic).max()  # of degree three
    return sum(abs(r.imag) < 1e-9 and abs(r) < 4 for r in np.roots(cubic[2:]))


def three_rrr(x, y, modes):
    """The determinant of the lines of the links at the platform of line_3rrr, with the elbows on the sides in `modes`."""
    angle, rows = PI / 10, []
    for foot, along, side in zip([(0, 0), (2, 0), (1, np.sqrt(3))], [None, angle, angle + PI / 3], modes):
        ex, ey = (0, 0) if along is None else (0.5 * np.cos(along), 0.5 * np.sin(along))
        dx, dy = x + ex - foot[0], y + ey - foot[1]
        bend = side * np.sqrt(1 / (dx**2 + dy**2) - 0.25)
        ux, uy = dx / 2 + bend * dy, dy / 2 - bend * dx
        rows.append([ux, uy, ex * uy - ey * ux])
    return np.linalg.det(np.moveaxis(np.array(rows), -1, 0))


def line_3rrr(y):
    """Places with the given y at which the determinant changes its sign, in all eight working modes together."""
    x, count = np.linspace(-2, 2, 400001), 0
    with np.errstate(invalid="ignore"):
        for modes in itertools.product([1, -1], repeat=3):
            values = three_rrr(x, y, modes)
            count += np.sum(values[1:] * values[:-1] < 0)
    return count


def degree_3rrr():
    """Of the product over all modes, times the denominators: how it grows along a complex line."""

    def product(t):
        x, y = np.array([0.31 + 0.83 * t]), np.array([-0.27 + 0.61 * t])
        value = np.prod([three_rrr(x, y, modes) for modes in itertools.product([1, -1], repeat=3)])
        for fx, fy in [(0, 0), (2 - 0.5 * np.cos(PI / 10), -0.5 * np.sin(PI / 10))]:
            value *= ((x[0] - fx) ** 2 + (y[0] - fy) ** 2) ** 4
        fx, fy = 1 - 0.5 * np.cos(PI / 10 + PI / 3), np.sqrt(3) - 0.5 * np.sin(PI / 10 + PI / 3)
        return value * ((x[0] - fx) ** 2 + (y[0] - fy) ** 2) ** 4

    t = 400 * np.exp(1j)
    return np.log2(abs(product(2 * t) / product(t)))


def three_rpr(place):
    """The determinant of the lines of the three legs of circle_3rpr, whose platform is turned by a right angle."""
    rows = []
    for base, top in [((0, 0), (0, 0)), ((4, 0), (0, 1)), ((1, 3), (-1, 0.5))]:
        x, y = place + np.array(top) - np.array(base)
        rows.append([x, y, top[0] * y - top[1] * x])
    return np.linalg.det(rows)


def ellipse():
    """Centre and half axes of the conic three_rpr = 0."""
    places = RANDOM.uniform(-3, 3, (30, 2))
    a, b, c, d, e, f = np.linalg.lstsq(
        np.array([[x * x, x * y, y * y, x, y, 1] for x, y in places]), [three_rpr(p) for p in places], rcond=None
    )[0]
    form = np.array([[a, b / 2], [b / 2, c]])
    centre = np.linalg.solve(2 * form, [-d, -e])
    return centre, np.sqrt((centre @ form @ centre - f) / np.linalg.eigvalsh(form))


def nearest(determinant, centre):
    """The distance of a point from determinant = 0: the least root along rays, whose directions close in on the best."""
    centre = np.array(centre, float)
    marks = np.linspace(-2, 2, 4)  # the determinant is of degree three along a line
    best, width, aim = np.inf, 10.0, np.zeros(len(centre))
    for _ in range(40):
        for ray in aim + width * RANDOM.normal(size=(30, len(centre))):
            ray /= np.linalg.norm(ray)
            for r in np.roots(np.polyfit(marks, [determinant(centre + m * ray) for m in marks], 3)):
                if abs(r.imag) < 1e-9 and abs(r) < best:
                    best, aim = abs(r), np.sign(r.real) * ray
        width = min(1, width) * 0.6
    return best


def orthoglide(factor):
    """Bounds of the velocity amplification on the cube, sampled."""
    low, high = -factor / np.sqrt(6), factor / (3 * np.sqrt(2))
    bounds = [np.inf, 0]
    for p in RANDOM.uniform(low, high, (20000, 3)).tolist() + [[low] * 3, [high] * 3]:
        rods = []
        for k in range(3):
            others = [p[j] for j in range(3) if j != k]
            along = -np.sqrt(1 - others[0] ** 2 - others[1] ** 2)
            rods.append([along if j == k else p[j] for j in range(3)])
        inverse = np.array(rods) / np.diag(rods)[:, None]  # the slides' rates from the tool's
        values = np.linalg.svd(inverse, compute_uv=False)
        bounds = [min(bounds[0], 1 / values[0]), max(bounds[1], 1 / values[-1])]
    return bounds


def rssr():
    def dead(x):  # the rod's equation, and its derivative by the rocker's angle
        t, p = x
        crank = np.array([0.5 * np.cos(t), 0.5 * np.sin(t), 0.3])
        rocker = np.array([1, 0.9 * np.cos(p), 0.9 * np.sin(p)])
        slope = np.array([0, -0.9 * np.sin(p), 0.9 * np.cos(p)])
        return np.array([(crank - rocker) @ (crank - rocker) - 1.25**2, (crank - rocker) @ slope])

    return len(roots(dead, 2, 400))


def baranov_truss():
    def gaps(x):  # the wing's angle, those of the links right and left, their hinge K
        wing, right, left = (turn(2, a)[:2, :2] for a in x[:3])
        hinge = x[3:]
        return np.array(
            [
                *(hinge + right @ [4, -1] - [4 + 6 * np.cos(-2.68), 6 * np.sin(-2.68)]),
                np.linalg.norm(wing @ [2, 2] - hinge - right @ [2, -2]) - 3.5,
                np.linalg.norm(wing @ [-1, 3] - hinge - left @ [-2, -1]) - 3,
                np.linalg.norm(hinge + left @ [-4, -1] - [-5, 0]) - 6,
            ]
        )

    return len(roots(gaps, 5, 1500, angles=slice(3), spread=6))


def screw(length, twist, angle):
    """From a joint's frame to the next one's: a turn about z, then along x and about x."""
    frame = np.eye(4)
    frame[:3, :3] = turn(2, angle) @ turn(0, twist)
    frame[:3, 3] = turn(2, angle) @ np.array([length, 0, 0])
    return frame


def ring_gap(links, angles):
    """How a ring of links (length, twist) fails to close."""
    frame = np.eye(4)
    for (length, twist), angle in zip(links, angles):
        frame = frame @ screw(length, twist, angle)
    return (frame - np.eye(4))[:3].ravel()


def closes_at_all_angles(links):
    """Newton's method closes the ring for the first joint at each of some angles; the largest gap that is left."""
    gaps = []
    for first in np.linspace(0.4, 1.6, 13):
        found = roots(lambda x: ring_gap(links, [first, *x]), len(links) - 1, 40)
        gaps.append(min([np.linalg.norm(ring_gap(links, [first, *x])) for x in found], default=np.inf))
    return max(gaps)


def bennett():
    a, b = (0.6, np.arcsin(0.6)), (0.8, np.arcsin(0.8))
    return closes_at_all_angles([a, b, a, b])


def bricard():
    return closes_at_all_angles([(1, PI / 2 * (-1) ** k) for k in range(6)])


def griffis_duffy():
    """The legs' lines are dependent in every pose: the largest determinant at random poses, the least with a leg moved."""
    corner = [np.array([np.cos(a), np.sin(a), 0]) * 2 / np.sqrt(3) for a in 2 * PI / 3 * np.arange(3)]
    middle = [(corner[k] + corner[(k + 1) % 3]) / 2 for k in range(3)]
    base = [corner[0], middle[0], corner[1], middle[1], corner[2], middle[2]]
    top = [middle[0], corner[1], middle[1], corner[2], middle[2], corner[0]]
    worst, usual = 0, np.inf
    for _ in range(200):
        angles, place = RANDOM.uniform(-1, 1, 3), RANDOM.uniform(-1, 1, 3) + np.array([0, 0, 1.5])
        frame = turn(2, angles[0]) @ turn(1, angles[1]) @ turn(0, angles[2])
        for moved in (False, True):
            feet = [base[0] + np.array([0.3, 0.2, 0.1]) * moved, *base[1:]]
            lines = [np.append(place + frame @ t - f, np.cross(f, place + frame @ t)) for f, t in zip(feet, top)]
            value = abs(np.linalg.det(lines))
            worst, usual = (worst, min(usual, value)) if moved else (max(worst, value), usual)
    return worst, usual


def cyclohexane():
    """Six atoms with given distances to the next and to the next but one: shapes by the rank of these twelve equations."""
    far = np.sqrt(8 / 3)  # of the next but one, for bonds of 1 and the tetrahedron's angle
    pairs = [(k, (k + 1) % 6, 1) for k in range(6)] + [(k, (k + 2) % 6, far) for k in range(6)]
    ranks = {"chair": set(), "boat": set()}
    for _ in range(300):
        x = RANDOM.normal(size=18)
        for _ in range(200):
            atoms = x.reshape(6, 3)
            gaps = np.array([(atoms[i] - atoms[j]) @ (atoms[i] - atoms[j]) - d * d for i, j, d in pairs])
            slopes = np.zeros((12, 6, 3))
            for row, (i, j, _) in enumerate(pairs):
                slopes[row, i], slopes[row, j] = 2 * (atoms[i] - atoms[j]), 2 * (atoms[j] - atoms[i])
            slopes = slopes.reshape(12, 18)
            if np.abs(gaps).max() < 1e-13:
                break
            x = x - np.linalg.lstsq(slopes, gaps, rcond=1e-9)[0]
        if np.abs(gaps).max() < 1e-12:
            across = [np.linalg.norm(atoms[k] - atoms[k + 3]) for k in range(3)]
            rank = np.sum(np.linalg.svd(slopes, compute_uv=False) > 1e-5)
            ranks["chair" if np.ptp(across) < 1e-6 else "boat"].add(int(rank))
    return ranks


def dietmaier():
    base = np.array(
        [
            (0, 0, 0),
            (1.107915, 0, 0),
            (0.549094, 0.756063, 0),
            (0.735077, -0.223935, 0.525991),
            (0.514188, -0.526063, -0.368418),
            (0.590473, 0.094733, -0.205018),
        ]
    )
    top = np.array(
        [
            (0, 0, 0),
            (0.542805, 0, 0),
            (0.956919, -0.528915, 0),
            (0.665885, -0.353482, 1.402538),
            (0.478359, 1.158742, 0.107672),
            (-0.137087, -0.235121, 0.353913),
        ]
    )
    legs = np.array([1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071])

    def turned(x):  # by a quaternion, of each point
        w, v = x[3], x[4:]
        return top * (w * w - v @ v) + 2 * np.outer(top @ v, v) + 2 * w * np.cross(v, top)

    found = []
    for _ in range(6000):
        x = np.append(RANDOM.uniform(-1, 1, 3), RANDOM.normal(size=4))
        x[3:] /= np.linalg.norm(x[3:])
        for _ in range(40):
            rods = x[:3] + turned(x) - base
            gaps = np.append(np.sum(rods**2, axis=1) - legs**2, x[3:] @ x[3:] - 1)
            if np.abs(gaps).max() < 1e-13:
                break
            w, v = x[3], x[4:]
            slopes = np.zeros((7, 7))
            slopes[:6, :3] = 2 * rods
            slopes[:6, 3] = 2 * np.sum(rods * (2 * w * top + 2 * np.cross(v, top)), axis=1)
            for k in range(3):
                e = np.eye(3)[k]
                moved = -2 * v[k] * top + 2 * np.outer(top[:, k], v) + 2 * np.outer(top @ v, e) + 2 * w * np.cross(e, top)
                slopes[:6, 4 + k] = 2 * np.sum(rods * moved, axis=1)
            slopes[6, 3:] = 2 * x[3:]
            step = np.linalg.lstsq(slopes, gaps, rcond=None)[0]
            x = x - step * min(1, 1 / max(np.linalg.norm(step), 1e-12))
        if np.abs(gaps).max() < 1e-11:
            x[3:] *= np.sign(x[3]) or 1
            if not any(np.abs(x - y).max() < 1e-6 for y in found):
                found.append(x)
    return len(found)


def main():
    others = [("rssr: forward singularities", rssr()), ("baranov_truss: assemblies", baranov_truss())]
    for name, number in [*arms(), *parallel_robots(), *others]:
        print(f"{name}: {number}")
    print(f"bennett: gap that is left at angles of the first joint: {bennett():.1e}")
    print(f"bricard: gap that is left at angles of the first joint: {bricard():.1e}")
    print(f"griffis_duffy: largest determinant at random poses, least with one leg moved: {griffis_duffy()}")
    print(f"cyclohexane: ranks of twelve equations: {cyclohexane()}")
    print(f"dietmaier: postures: {dietmaier()}")
    print(f"stewart_line: places on x = -0.7, y = 0.1: {stewart_line(-0.7, 0.1)}")
    print(f"stewart_line: places on x = 0.2, y = 0.3: {stewart_line(0.2, 0.3)}")
    for d3, d4 in [(2, 0.19), (2, 0.21), (2, 2.08), (2, 2.1), (2, 2.12), (2, 2.82), (2, 2.84), (0.5, 1.11), (0.5, 1.13)]:
        print(f"orthogonal_3r_map: cusps, d3 = {d3}, d4 = {d4}: {cusps_of_3r(d3, d4, 1)}")
    for legs, starts in [((1, 1.1, 1.2), 500), ((1.3, 1.35, 1.4), 2000), ((1.52, 1.55, 1.58), 2000)]:
        print(f"upu_modes: postures, legs {legs}: {upu(legs, starts)}")
    print(f"line_3rrr: places with y = -1/5, y = 3/10: {line_3rrr(-0.2)}, {line_3rrr(0.3)}; degree {degree_3rrr():.3f}")
    for cx in (0.2, 0.5, -0.5):
        print(f"degenerate_3rpr: cx = {cx}: cusps for legs longer than {degenerate_3rpr(cx, 0.8)}")
    print(f"rpr_2prr: cusps, leg 1/2, leg 1/4: {rpr_2prr(0.5)}, {rpr_2prr(0.25)}")
    print(f"circle_3rpr: centre and half axes of the ellipse: {ellipse()}")
    print(f"circle_3rpr: radius about (5/2, 1/2): {nearest(three_rpr, (2.5, 0.5)):.6f}")
    print(f"sphere_6ups: radius about (1/5, 3/10, 1): {nearest(hexapod, (0.2, 0.3, 1)):.6f}")
    corner = (0.5, -0.5, 1.5)
    others = [nearest(hexapod, p) for p in RANDOM.uniform((-0.5, -0.5, 0.5), (0.5, 0.5, 1.5), (8, 3))]
    print(f"sphere_6ups: radius about {corner}: {nearest(hexapod, corner):.6f}, about others: {max(others):.6f} at most")
    for factor in (0.99, 1, 1.01):
        low, high = orthoglide(factor)
        print(f"orthoglide: amplification on the cube times {factor}: {low:.4f} to {high:.4f}")


if __name__ == "__main__":
    main()
