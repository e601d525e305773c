// Worlds of all four scalars through the C# classes: first what hello_hashes.cpp prints too, then what must hold.
// SPDX-License-Identifier: MIT
using System;

internal static class WorldTest
{
    private static void Main(string[] arguments)
    {
        if (arguments[0] == "hello")
        {
            HelloF32.Play();
            HelloF64.Play();
            HelloFixed16.Play();
            HelloFixed32.Play();
            return;
        }
        Each("layout", Layout.Check);
        Each("what is wrong is said", HelloF32.WhatIsWrongIsSaid, HelloF64.WhatIsWrongIsSaid,
            HelloFixed16.WhatIsWrongIsSaid, HelloFixed32.WhatIsWrongIsSaid);
        Each("an exception in a step is made good", HelloF32.AnExceptionInAStepIsMadeGood,
            HelloF64.AnExceptionInAStepIsMadeGood, HelloFixed16.AnExceptionInAStepIsMadeGood,
            HelloFixed32.AnExceptionInAStepIsMadeGood);
        Each("records come and go", HelloF32.RecordsComeAndGo, HelloF64.RecordsComeAndGo, HelloFixed16.RecordsComeAndGo,
            HelloFixed32.RecordsComeAndGo);
        Each("settings take nothing back", HelloF32.SettingsTakeNothingBack, HelloF64.SettingsTakeNothingBack,
            HelloFixed16.SettingsTakeNothingBack, HelloFixed32.SettingsTakeNothingBack);
        Each("a body that grows stays on its ground", HelloF32.ABodyThatGrowsStaysOnItsGround,
            HelloF64.ABodyThatGrowsStaysOnItsGround, HelloFixed16.ABodyThatGrowsStaysOnItsGround,
            HelloFixed32.ABodyThatGrowsStaysOnItsGround);
        Each("setters of a hinge drive it", HelloF32.SettersOfAHingeDriveIt, HelloF64.SettersOfAHingeDriveIt,
            HelloFixed16.SettersOfAHingeDriveIt, HelloFixed32.SettersOfAHingeDriveIt);
        Each("a recording is proved", HelloF32.ARecordingIsProved, HelloF64.ARecordingIsProved,
            HelloFixed16.ARecordingIsProved, HelloFixed32.ARecordingIsProved);
        Each("nothing is allocated a frame", HelloF32.NothingIsAllocatedAFrame, HelloF64.NothingIsAllocatedAFrame,
            HelloFixed16.NothingIsAllocatedAFrame, HelloFixed32.NothingIsAllocatedAFrame);
    }

    private static void Each(string what, params Action[] tests)
    {
        foreach (Action test in tests) test();
        Console.WriteLine(what);
    }
}
