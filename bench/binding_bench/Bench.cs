// A frame of 1000 boxes with its poses read, and single calls; native.cpp has the same in C++.
// SPDX-License-Identifier: MIT
using System;
using System.Globalization;
using System.Runtime.InteropServices;
using Isostep;

internal static class Bench
{
    private const int Bodies = 1000, Rounds = 5, Frames = 200, Calls = 1000000, Reads = 4000;

    [DllImport("libc")]
    private static extern IntPtr clock();

    private static void Main()
    {
        CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;
        BodyId[] bodies = new BodyId[Bodies];
        using (Isostep.F32.World world = HelloF32.Pile(Bodies, bodies)) Measure("F32", world);
        using (Isostep.Fixed32.World world = HelloFixed32.Pile(Bodies, bodies)) Measure("Fixed32", world);
        MeasureCalls();
        MeasureNumbers();
    }

    /// [ms] Processor time, as native.cpp.
    private static double Now() => (long)clock() / 1000.0;

    private static void Measure(string name, WorldBase world)
    {
        double sum = 0;
        using (Snapshot start = new Snapshot(world))
        {
            world.Save(start);
            double frame = Least(Frames, () => world.Load(start), () =>
            {
                world.Step();
                sum += Heights(world);
            });
            Console.WriteLine("{0} {1:F4} ms a frame, sum {2:G6}", name, frame, sum);
        }
        double poses = Least(Reads, () => {}, () => sum += Heights(world));
        Console.WriteLine("{0} {1:F4} us for its poses, sum {2:G6}", name, poses * 1000, sum);
    }

    /// [ms] One `work`, the least of several rounds of so many, each after `begin`.
    private static double Least(int times, Action begin, Action work)
    {
        double least = double.MaxValue;
        for (int round = 0; round < Rounds; ++round)
        {
            begin();
            double start = Now();
            for (int i = 0; i < times; ++i) work();
            least = Math.Min(least, (Now() - start) / times);
        }
        return least;
    }

    private static double Heights(WorldBase world)
    {
        double sum = 0;
        RenderPoseView poses = world.Poses(0.5f);
        for (int k = 0; k < poses.Count; ++k) sum += poses[k].Position.Y;
        return sum;
    }

    private static void MeasureCalls()
    {
        using (Isostep.F32.World world = new Isostep.F32.World())
        {
            ShapeId ball = world.AddSphere(Isostep.F32.Sphere.Of(1));
            BodyId body = world.CreateBody(
                Isostep.F32.BodyDefinition.Of(BodyType.Dynamic, ball, new Isostep.F32.Vec3()));
            Isostep.F32.Vec3 impulse = new Isostep.F32.Vec3();
            Time("BodyExists", () => world.BodyExists(body));
            Time("GetBodyState", () => world.GetBodyState(body));
            Time("ApplyImpulse", () => world.ApplyImpulse(body, impulse));
        }
    }

    private static void MeasureNumbers()
    {
        Q32 a = Q32.Ratio(7, 3), b = Q32.Ratio(-5, 9);
        Time("Q32 *", () => a = (a * b).Raw == 0 ? b : a);
        Time("Q32 /", () => a = (a / b).Raw == 0 ? b : a);
        Time("Q32.Sqrt", () => Q32.Sqrt(a));
        Time("Q32.Sin", () => Q32.Sin(a));
        Time("Q32.Atan2", () => Q32.Atan2(a, b));
        Time("Q32.Exp", () => Q32.Exp(b));
    }

    /// The call of the delegate itself, 2 ns, is in it.
    private static void Time(string name, Action action)
    {
        Console.WriteLine("{0} {1:F1} ns", name, Least(Calls / Rounds, () => {}, action) * 1e6);
    }
}
