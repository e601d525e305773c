// Tests for Unity's test runner, in the editor and on devices: is the library there, and is this machine sound?
// SPDX-License-Identifier: MIT
using Isostep;
using Isostep.Fixed32;
using NUnit.Framework;

namespace Isostep.Tests
{
    public sealed class MachineTests
    {
        [Test]
        public void TheMachineReplaysEveryRecording()
        {
            SelfcheckResult result = Library.Selfcheck();
            Assert.IsTrue(result.Sound, result.Text);
            Assert.Greater(result.Frames, 0);
        }

        [Test]
        public void TheNumbersAreThoseOfTheLibrary()
        {
            Assert.AreEqual(6074001000, Q32.Sqrt(2).Raw);
            Assert.AreEqual(Native.iso_q32_from_double(0.1), Q32.FromDouble(0.1).Raw);
            Assert.AreEqual(Native.iso_q16_from_double(-0.7), Q16.FromDouble(-0.7).Raw);
        }

        [Test]
        public void ARollbackGivesTheSameHash()
        {
            using (World world = new World())
            using (Snapshot frame = new Snapshot(world))
            {
                ShapeId ball = world.AddSphere(Sphere.Of(Q32.Half));
                world.CreateBody(BodyDefinition.Of(BodyType.Dynamic, ball, new Vec3(0, 2, 0)));
                world.Save(frame);
                for (int i = 0; i < 60; ++i) world.Step();
                ulong hash = world.Hash;
                world.Load(frame);
                Assert.AreNotEqual(hash, world.Hash);
                for (int i = 0; i < 60; ++i) world.Step();
                Assert.AreEqual(hash, world.Hash);
            }
        }
    }
}
