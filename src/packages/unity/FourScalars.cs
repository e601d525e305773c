// The example of the C# package: prints what four_scalars.c prints.
// SPDX-License-Identifier: MIT
internal static class FourScalars
{
    private static void Main()
    {
        CrateF32.Play("f32");
        CrateF64.Play("f64");
        CrateFixed16.Play("q16");
        CrateFixed32.Play("q32");
    }
}
