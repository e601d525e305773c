// A frame of 1000 boxes with its poses read, and single calls; native.cpp has the same in C++.
// SPDX-License-Identifier: MIT
using System;
using System.Diagnostics;
using System.Globalization;
using Isostep;

internal static class Bench
{
    private const int Bodies = 1000, Frames = 200, Calls = 1000000, Reads = 20000;

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
    private static double Now() => Process.GetCurrentProcess().TotalProcessorTime.TotalMilliseconds;

    private static void Measure(string name, WorldBase world)
    {
        double sum = 0;
        double begin = Now();
        for (int i = 0; i < Frames; ++i)
        {
            world.Step();
            sum += Heights(world);
        }
        Console.WriteLine("{0} {1:F4} ms a frame, sum {2:G6}", name, (Now() - begin) / Frames, sum);
        begin = Now();
        for (int i = 0; i < Reads; ++i) sum += Heights(world);
        Console.WriteLine("{0} {1:F4} us for its poses, sum {2:G6}", name, (Now() - begin) / Reads * 1000, sum);
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
        for (int i = 0; i < 1000; ++i) action();
        double begin = Now();
        for (int i = 0; i < Calls; ++i) action();
        Console.WriteLine("{0} {1:F1} ns", name, (Now() - begin) / Calls * 1e6);
    }
}
